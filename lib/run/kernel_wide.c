/* kernel_wide.c - the large functions of the kernel, once per variant; see DAL_SHARED. */
#undef DAL_LINKED
#define DAL_LINKS
#include "kernel/acceptance.h"
#include "kernel/observables.h"
#include "kernel/series.h"
#include <dalembert_kernel.h>
