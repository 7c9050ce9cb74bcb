/* parts.h - what the source of an integrator uses of the kernel, for its descriptor.
 *
 * A generated file has these parts alone, with those that they use themselves, and of the callbacks
 * besides the field those that are named here. */
#ifndef DAL_KERNEL_PARTS_H
#define DAL_KERNEL_PARTS_H

/* The parts of the kernel, and the callbacks. */
enum {
    DAL_KERNEL_FUNCTIONS = 1 << 0,      /* dal_sin, ...: elementary.h */
    DAL_KERNEL_ALGEBRA = 1 << 1,        /* algebra.h */
    DAL_KERNEL_SOLVE = 1 << 2,          /* dal_solve */
    DAL_KERNEL_EULER = 1 << 3,          /* dal_symplectic_euler */
    DAL_KERNEL_COLLOCATION = 1 << 4,    /* dal_collocation */
    DAL_KERNEL_COMPOSITION = 1 << 5,    /* dal_substeps */
    DAL_KERNEL_BLOCKS = 1 << 6,         /* dal_eval_blocks */
    DAL_KERNEL_ENFORCE = 1 << 7,        /* dal_enforce */
    DAL_KERNEL_SPARK = 1 << 8,          /* dal_spark_advance */
    DAL_KERNEL_METHOD_STATE = 1 << 9,   /* dal_save_method_state */
    DAL_KERNEL_TANGENT = 1 << 10,       /* dal_begin_tangent */
    DAL_KERNEL_CONSTRAINT = 1 << 11,    /* DAL_EVAL_CONSTRAINT */
    DAL_KERNEL_ENERGY_NORMAL = 1 << 12, /* DAL_EVAL_ENERGY_NORMAL */
    DAL_KERNEL_POTENTIAL = 1 << 13,     /* DAL_EVAL_POTENTIAL */
    DAL_KERNEL_CONTROL = 1 << 14,       /* dal_control, with a tolerance */
    DAL_KERNEL_SERIES = 1 << 15,        /* dal_expand_first */
    DAL_KERNEL_CORRECTION = 1 << 16,    /* DAL_EVAL_CORRECTION, dal_clear_momenta */
    DAL_KERNEL_ENFORCEMENT = 1 << 17,   /* dal_eval_enforcement, dal_clear_momenta */
    DAL_KERNEL_REACTION = 1 << 18       /* DAL_EVAL_REACTION */
};

#endif
