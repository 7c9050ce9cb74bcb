/* test_null_codegen.c - NULL, nameless settings and negative counts, given to generated code and
 * compiled steps. */
#include "dalembert_codegen.h"
#include "null.h"
#include <stdlib.h>
#include <string.h>

FUNCTIONS_dalembert_codegen(DECLARE_NULL_TEST)

    static dal_model *model;
static dal_run_spec spec;
static dal_run *run;
static dal_batch *batch;
static char buffer[64];

static int open_objects(void) { return open_runs(&model, &spec, &run, &batch); }

static int close_objects(void) { return close_runs(model, run, batch); }

static void null_dal_generate(void)
{
    char *text = buffer;
    REFUSED(dal_generate(&spec, NULL, NULL, error));
    for (int i = 0; i < BAD_SPECS; i++)
        REFUSED(dal_generate(spoil_spec(&spec, i), NULL, &text, error));
    REFUSED(dal_generate(&spec, &(dal_generate_options){.lanes = -1}, &text, error));
    CU_ASSERT_PTR_NULL(text);
}

static void null_dal_model_latex(void)
{
    char *text = buffer;
    REFUSED(dal_model_latex(NULL, &text, error));
    REFUSED(dal_model_latex(model, NULL, error));
    CU_ASSERT_PTR_NULL(text);
}

static void null_dal_model_mathml(void)
{
    char *text = buffer;
    REFUSED(dal_model_mathml(NULL, &text, error));
    REFUSED(dal_model_mathml(model, NULL, error));
    CU_ASSERT_PTR_NULL(text);
}

static const dal_native_options nowhere = {.cache = NULL};

static void null_dal_run_native(void)
{
    REFUSED(dal_run_native(NULL, &nowhere, error));
    REFUSED(dal_run_native(run, NULL, error));
    REFUSED(dal_run_native(run, &nowhere, error));
}

static void null_dal_run_is_native(void) { CU_ASSERT_EQUAL(dal_run_is_native(NULL), 0); }

static void null_dal_run_native_observables(void)
{
    REFUSED(dal_run_native_observables(NULL, &nowhere, error));
    REFUSED(dal_run_native_observables(run, NULL, error));
    REFUSED(dal_run_native_observables(run, &nowhere, error));
}

static void null_dal_batch_native(void)
{
    REFUSED(dal_batch_native(NULL, &nowhere, error));
    REFUSED(dal_batch_native(batch, NULL, error));
    REFUSED(dal_batch_native(batch, &nowhere, error));
}

static void null_dal_batch_is_native(void) { CU_ASSERT_EQUAL(dal_batch_is_native(NULL), 0); }

typedef dal_status native_begin(dal_native **native, const dal_run *run,
                                const dal_native_options *options, dal_error *error);

static void refuse_begin(native_begin *begin)
{
    dal_native *native = (dal_native *)(void *)buffer;
    REFUSED(begin(NULL, run, &nowhere, error));
    REFUSED(begin(&native, NULL, &nowhere, error));
    REFUSED(begin(&native, run, NULL, error));
    REFUSED(begin(&native, run, &nowhere, error));
    CU_ASSERT_PTR_NULL(native);
}

static void null_dal_native_begin(void) { refuse_begin(dal_native_begin); }

static void null_dal_native_begin_observables(void) { refuse_begin(dal_native_begin_observables); }

static void null_dal_native_begin_batch(void)
{
    dal_native *native = (dal_native *)(void *)buffer;
    REFUSED(dal_native_begin_batch(NULL, batch, &nowhere, error));
    REFUSED(dal_native_begin_batch(&native, NULL, &nowhere, error));
    REFUSED(dal_native_begin_batch(&native, batch, NULL, error));
    CU_ASSERT_PTR_NULL(native);
}

static void null_dal_native_poll(void)
{
    dal_error why = {0};
    CU_ASSERT_EQUAL(dal_native_poll(NULL, NULL), DAL_NATIVE_FAILED);
    CU_ASSERT_EQUAL(dal_native_poll(NULL, &why), DAL_NATIVE_FAILED);
    CU_ASSERT_EQUAL(why.status, DAL_STATUS_ARGUMENT);
}

static void null_dal_native_fits(void) { CU_ASSERT_EQUAL(dal_native_fits(NULL, run), 0); }

static void null_dal_run_use_native(void)
{
    REFUSED(dal_run_use_native(NULL, NULL, error));
    REFUSED(dal_run_use_native(run, NULL, error));
}

static void null_dal_batch_use_native(void)
{
    REFUSED(dal_batch_use_native(NULL, NULL, error));
    REFUSED(dal_batch_use_native(batch, NULL, error));
}

static void null_dal_native_free(void) { dal_native_free(NULL); }

void suite_null_codegen(void)
{
    CU_pSuite suite =
        CU_add_suite("NULL and negative counts: compiled steps", open_objects, close_objects);
    FUNCTIONS_dalembert_codegen(ADD_NULL_TEST)
}
