/* null.h - the rule for NULL, NULL names and negative counts: see dalembert.h, conventions.
 *
 * A suite has a test null_NAME for every function of the lists that tools/header-functions.awk
 * makes of the headers: without one it is not linked. */
#ifndef NULL_H
#define NULL_H

#include "functions.h"
#include <CUnit/CUnit.h>
#include <dalembert.h>
#include <math.h>
#include <stddef.h>

/* Where the calls under test report. */
static dal_error *error;

/* DAL_STATUS_ARGUMENT, from a function that takes no record. */
#define REFUSED_STATUS(call) CU_ASSERT_EQUAL((call), DAL_STATUS_ARGUMENT)
/* The same with a message, from a call that hands error over. */
#define REFUSED_WITH_RECORD(call)                                                                  \
    do {                                                                                           \
        dal_error record = {0};                                                                    \
        error = &record;                                                                           \
        REFUSED_STATUS(call);                                                                      \
        CU_ASSERT(record.status == DAL_STATUS_ARGUMENT && record.message[0] != '\0');              \
        CU_ASSERT(record.line == 0 && record.column == 0);                                         \
    } while (0)
/* The same without a record: error is NULL. */
#define REFUSED_WITHOUT_RECORD(call)                                                               \
    do {                                                                                           \
        error = NULL;                                                                              \
        REFUSED_STATUS(call);                                                                      \
    } while (0)
#define REFUSED(call)                                                                              \
    do {                                                                                           \
        REFUSED_WITH_RECORD(call);                                                                 \
        REFUSED_WITHOUT_RECORD(call);                                                              \
    } while (0)

/* Settings that nobody may give, as "settings, count". */
#define COUNT_NEGATIVE   NULL, -1
#define SETTINGS_MISSING NULL, 2
static const dal_setting nameless[] = {{NULL, 1.0}};
#define NAME_MISSING nameless, 1

/* A spec of the Chaplygin sleigh and its model, made where CUnit allows no assertion. */
static inline dal_status open_spec(dal_model **model, dal_run_spec *spec)
{
    *spec = (dal_run_spec){.options = dal_options_default()};
    dal_status status = dal_model_builtin(model, "chaplygin-sleigh", NULL);
    if (status == DAL_STATUS_OK) status = dal_model_system(*model, &spec->system, NULL);
    return status == DAL_STATUS_OK ? dal_method_parse(&spec->method, "rk4", NULL) : status;
}

/* The same with a run and a batch; 0, or what CUnit takes for a failure. */
static inline int open_runs(dal_model **model, dal_run_spec *spec, dal_run **run, dal_batch **batch)
{
    return open_spec(model, spec) != DAL_STATUS_OK ||
           dal_run_create(run, spec, NULL) != DAL_STATUS_OK ||
           dal_batch_create(batch, spec, 3, 0, NULL) != DAL_STATUS_OK;
}

static inline int close_runs(dal_model *model, dal_run *run, dal_batch *batch)
{
    dal_batch_free(batch);
    dal_run_free(run);
    dal_model_free(model);
    return 0;
}

/* Specs that no function may take, and none at all. */
enum { BAD_SPECS = 8 };
static inline const dal_run_spec *spoil_spec(const dal_run_spec *spec, int i)
{
    static dal_run_spec bad;
    bad = *spec;
    if (i == 1) bad.system = NULL;
    if (i == 2) bad.parameter_count = -1;
    if (i == 3) bad.parameter_count = 2;
    if (i == 4) bad.parameters = nameless, bad.parameter_count = 1;
    if (i == 5) bad.start_count = -1;
    if (i == 6) bad.start_count = 2;
    if (i == 7) bad.start = nameless, bad.start_count = 1;
    return i == 0 ? NULL : &bad;
}

#define DECLARE_NULL_TEST(name) static void null_##name(void);
#define ADD_NULL_TEST(name)     CU_add_test(suite, #name, null_##name);

#endif
