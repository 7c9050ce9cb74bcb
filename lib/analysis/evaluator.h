/* evaluator.h - what functions of an evaluator check of their arguments. */
#ifndef DAL_EVALUATOR_H
#define DAL_EVALUATOR_H

#include "core/arguments.h"

/* A public function requires a point with q and v. */
#define DAL_REQUIRE_POINT(at)                                                                      \
    do {                                                                                           \
        DAL_REQUIRE(at, NULL);                                                                     \
        DAL_REQUIRE((at)->q, NULL);                                                                \
        DAL_REQUIRE((at)->v, NULL);                                                                \
    } while (0)

#endif
