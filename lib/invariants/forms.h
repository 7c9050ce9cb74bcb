/* forms.h - an invariant as a formula. */
#ifndef DAL_INVARIANTS_FORMS_H
#define DAL_INVARIANTS_FORMS_H

#include "invariants/search.h"

/* A formula of a row of the basis, malloc'ed text. */
typedef struct dal__row_form {
    char *text;
    int degree, terms;
    bool may_hold_for_any; /* its coefficients are known for any parameters */
} dal__row_form;

/* Writes row[products] with coefficients that are rational, times powers of parameters, where they
 * are.  [alloc]  Errors: DAL_STATUS_MEMORY, DAL_STATUS_NOT_FINITE. */
dal_status dal__write_form(const dal__search *search, const dal__condition *condition,
                           const double *row, dal__row_form *form);

/* Other values of the parameters, [parameters]; one that is 0 is not 0 then. */
void dal__other_parameters(const dal__equations *e, const double *parameter, double *other);

#endif
