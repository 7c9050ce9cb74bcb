/* pi.h - the number pi. */
#ifndef DAL_PI_H
#define DAL_PI_H

#define DAL__PI 3.14159265358979323846

#endif
