/* chain_one.h - the contact chain of the examples with one link: coordinates z_0, z_1, y_1. */
#ifndef CHAIN_ONE_H
#define CHAIN_ONE_H

#include <dalembert.h>

const dal_system *chain_one(void);

#endif
