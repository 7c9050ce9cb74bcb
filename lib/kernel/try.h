/* try.h - returns the status of a call that failed. */
#ifndef DAL_KERNEL_TRY_H
#define DAL_KERNEL_TRY_H

/* A compiler that does not know this takes the code behind several DAL_TRY for cold and leaves it
 * slow. */
#define DAL_RARELY(condition) __builtin_expect(!!(condition), 0)

#define DAL_TRY(expression)                                                                        \
    do {                                                                                           \
        dal_status dal__s = (expression);                                                          \
        if (DAL_RARELY(dal__s != DAL_OK)) return dal__s;                                           \
    } while (0)

#endif
