/* order_screen.h - errors and orders on a terminal. */
#ifndef DAL_CLI_ORDER_SCREEN_H
#define DAL_CLI_ORDER_SCREEN_H

#include "order_study.h"

/* Prints the first methods, those that failed or were refused, and the method of the least time.
 * Returns CLI_DONE, or prints and returns CLI_IO. */
int order_print_screen(const order_study *s);

#endif
