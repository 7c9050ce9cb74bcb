/* dalembert_measure.h - measures; a part of dalembert.h, never included by itself. */
#ifndef DALEMBERT_MEASURE_H
#define DALEMBERT_MEASURE_H

#endif
