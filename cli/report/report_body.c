/* report_body.c - the outlines of bodies, as the path of a run and its motion show them. */
#include "report_body.h"

#include <stddef.h>

const char *const body_name[DAL_BODY_COUNT] = {
#define BODY_NAME(code, name) name,
    DAL_BODY_LIST(BODY_NAME)
#undef BODY_NAME
};

/* An axle of half length 0.45 about a point beside the pivot, and its wheels, 0.6 long. */
#define AXLE(body_, x, y, turn_, along)                                                            \
    {.body = body_,                                                                                \
     .pivot = {x, y},                                                                              \
     .turn = turn_,                                                                                \
     .count = 2,                                                                                   \
     .at = {{along, 0.45}, {along, -0.45}}},                                                       \
        {.body = body_,                                                                            \
         .pivot = {x, y},                                                                          \
         .turn = turn_,                                                                            \
         .count = 2,                                                                               \
         .at = {{along - 0.3, 0.45}, {along + 0.3, 0.45}}},                                        \
    {                                                                                              \
        .body = body_, .pivot = {x, y}, .turn = turn_, .count = 2, .at = {                         \
            {along - 0.3, -0.45},                                                                  \
            {along + 0.3, -0.45}                                                                   \
        }                                                                                          \
    }

static const body_shape shapes[] = {
    {DAL_BODY_POINT, .radius = 0.3},
    {DAL_BODY_SLEIGH, .count = 6,
     .at = {{1.2, 0}, {0.4, 0.55}, {-0.9, 0.55}, {-0.9, -0.55}, {0.4, -0.55}, {1.2, 0}}},
    {DAL_BODY_SLEIGH, .count = 2, .at = {{-0.5, 0}, {0.5, 0}}},
    {DAL_BODY_BLADE, .count = 2, .at = {{-1, 0}, {1, 0}}},
    {DAL_BODY_BLADE, .count = 3, .at = {{0.5, 0.3}, {1, 0}, {0.5, -0.3}}},
    {DAL_BODY_DISK, .is_narrowed = true, .radius = 1},
    {DAL_BODY_DISK, .count = 2, .at = {{0, -0.35}, {0, 0.35}}}, /* the axle; upright, a line */
    {DAL_BODY_BALL, .radius = 0.7},
    {DAL_BODY_BOX, .count = 5, .at = {{1, 0.6}, {-1, 0.6}, {-1, -0.6}, {1, -0.6}, {1, 0.6}}},
    {DAL_BODY_ROBOT, .radius = 0.9},
    {DAL_BODY_ROBOT, .count = 2, .at = {{0, 0}, {0.9, 0}}},
    {DAL_BODY_BOARD, .count = 2, .at = {{-1, 0}, {1, 0}}},
    AXLE(DAL_BODY_BOARD, 1, 0, 1, 0),
    AXLE(DAL_BODY_BOARD, -1, 0, -1, 0),
    {DAL_BODY_RACER, .count = 2, .at = {{0, 0}, {1.2, 0}}},
    {DAL_BODY_RACER, .pivot = {1.2, 0}, .turn = 1, .count = 2, .at = {{0, 0}, {0.7, 0}}},
    AXLE(DAL_BODY_RACER, 0, 0, 0, 0),
    AXLE(DAL_BODY_RACER, 1.2, 0, 1, 0.7),
};

const body_shape *body_next(dal_body body, const body_shape *shape)
{
    const body_shape *const end = shapes + sizeof shapes / sizeof shapes[0];
    for (shape = shape ? shape + 1 : shapes; shape < end; shape++)
        if (shape->body == body) return shape;
    return NULL;
}
