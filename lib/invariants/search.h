/* search.h - what a search for invariants is about: atoms, their products, a condition. */
#ifndef DAL_INVARIANTS_SEARCH_H
#define DAL_INVARIANTS_SEARCH_H

#include "dalembert_invariants.h"
#include "invariants/points.h"

enum { DAL__MAX_PRODUCTS = 800, DAL__MAX_DEGREE = 8 };

/* A factor of products. */
typedef struct dal__atom {
    const char *text; /* the model's */
    dal__node node;
} dal__atom;

/* Product k is product parent times atom last; product 0 is 1. */
typedef struct dal__product {
    int parent, last;
} dal__product;

/* The atoms of a search, and their products in the order of degrees. */
typedef struct dal__search {
    dal_model *model;
    dal__region region;
    const double *parameter; /* [parameters] */
    int degree;
    int atoms, capacity;
    dal__atom *atom;
    int products; /* with product 0 */
    dal__product *product;
} dal__search;

/* What is sought, f' + power f tr F_v = 0; with power 0 functions that differ by a constant are
 * one. */
typedef struct dal__condition {
    double power;
    bool has_constants;
} dal__condition;

#endif
