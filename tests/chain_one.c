/* chain_one.c - the contact chain with one link, which is the contact oscillator. */
#define CHAIN_LINKS 1
#include "chain_one.h"
#include "../examples/contact_chain.h"

const dal_system *chain_one(void) { return &chain_system; }
