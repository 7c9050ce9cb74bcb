/* report_pose.c - where the body of a run is at each of its rows. */
#include "report_pose.h"
#include "ui/memory.h"
#include "ui/message.h"

#include "io/file.h"
#include "run/columns.h"
#include "run/manifest.h"
#include "run/system.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Of the mean time between rows: what a difference of poses is taken over. */
static const double small_fraction = 1e-4;

/* The first pair of which a system has both: a plane, with one scale.  Otherwise the first two
 * coordinates, or a single one over t, whose number is -1. */
static bool find_pair(const dal_system *system, const char *axis[2], int pair[2])
{
    static const char *const pairs[][2] = {{"x", "y"}, {"x1", "x2"}, {"y1", "y2"}};
    for (size_t k = 0; k < sizeof pairs / sizeof pairs[0]; k++) {
        for (int side = 0; side < 2; side++) {
            axis[side] = pairs[k][side];
            pair[side] = cli_find_coordinate(system, axis[side]);
        }
        if (pair[0] >= 0 && pair[1] >= 0) return true;
    }
    const bool is_single = system->n == 1;
    for (int side = 0; side < 2; side++) {
        pair[side] = side - is_single;
        axis[side] = pair[side] < 0 ? "t" : system->coordinate[pair[side]];
    }
    return false;
}

/* Poses need all of q and v, which a run with --columns may not have. */
static bool has_state(const pose_reader *p)
{
    const dal_system *system = p->simulation.system;
    const int n = system->n;
    if (p->rows.columns <= 2 * n) return false;
    for (int i = 0; i < n; i++) {
        const char *coordinate = system->coordinate[i], *velocity = p->rows.name[1 + n + i];
        if (strcmp(p->rows.name[1 + i], coordinate) != 0 ||
            !columns_is_velocity(&p->simulation.request, velocity, coordinate))
            return false;
    }
    return true;
}

/* Whether a row has the error, the last of that name. */
static bool has_error(const trajectory_reader *rows)
{
    int i = rows->columns - 1;
    while (i > 0 && strcmp(rows->name[i], "error") != 0) i--;
    return i > 0;
}

/* The directory of a run may be gone: a study does not need it. */
int pose_open(pose_reader *p, const char *run)
{
    dal_run_spec spec;
    dal_error error;
    *p = (pose_reader){.simulation = simulation_default(), .dir = {.descriptor = -1}};
    run_directory_open(&p->dir, run);
    if (!file_exists(p->dir.manifest)) return CLI_DONE;
    int status = manifest_read(&p->dir, &p->simulation.request);
    if (status == CLI_DONE) status = simulation_make_spec(&p->simulation, &spec);
    if (status != CLI_DONE) return status;
    const dal_system *system = p->simulation.system;
    p->is_plane = system->picture != NULL;
    if (!p->is_plane) {
        p->is_plane = find_pair(system, p->axis, p->pair);
    } else {
        p->body = system->picture->body;
        p->axis[0] = "x";
        p->axis[1] = "y";
    }
    if (dal_evaluator_create(&p->evaluator, system, p->simulation.request.set.item,
                             p->simulation.request.set.count, &error))
        return cli_error(CLI_USAGE, run, &error);
    status = reader_open(&p->rows, run);
    if (status != CLI_DONE) return status;
    p->is_open = true;
    p->q = cli_calloc((size_t)system->n, sizeof *p->q);
    p->exact = cli_calloc(2 * (size_t)system->n, sizeof *p->exact);
    p->has_exact = system->exact && has_error(&p->rows);
    p->has_poses = p->rows.count > 0 && has_state(p);
    const run_request *request = &p->simulation.request;
    p->small_time = small_fraction * (request->time - request->from) / (double)(p->rows.count + 1);
    return CLI_DONE;
}

void pose_of(pose_reader *p, double t, const double *q, const double *v, double *pose)
{
    const dal_system *system = p->simulation.system;
    for (int i = 0; i < DAL_PICTURE_COUNT; i++) pose[i] = 0.0;
    if (!system->picture)
        for (int k = 0; k < 2; k++) pose[k] = p->pair[k] < 0 ? t : q[p->pair[k]];
    else if (dal_evaluator_call(p->evaluator, system->picture->evaluate, t, q, v, NULL, pose))
        pose[DAL_PICTURE_X] = NAN;
}

bool pose_of_exact(pose_reader *p, double t, double *pose)
{
    const dal_system *system = p->simulation.system;
    const double *none = p->q; /* it depends on t alone */
    if (dal_evaluator_call(p->evaluator, system->exact, t, none, none, NULL, p->exact))
        return false;
    pose_of(p, t, p->exact, p->exact + system->n, pose);
    double sum = 0.0;
    for (int i = 0; i < DAL_PICTURE_COUNT; i++) sum += pose[i];
    return isfinite(sum);
}

/* The pose a while after a state, while q changes by v alone. */
static void find_pose(pose_reader *p, const double *q, const double *v, double after, double *pose)
{
    for (int i = 0; i < p->simulation.system->n; i++) p->q[i] = q[i] + after * v[i];
    pose_of(p, p->t + after, p->q, v, pose);
}

void pose_set(pose_reader *p, double t, const double *q, const double *v)
{
    double before[DAL_PICTURE_COUNT], after[DAL_PICTURE_COUNT];
    p->t = t;
    find_pose(p, q, v, 0.0, p->pose);
    find_pose(p, q, v, -p->small_time, before);
    find_pose(p, q, v, p->small_time, after);
    for (int i = 0; i < DAL_PICTURE_COUNT; i++)
        p->rate[i] = (after[i] - before[i]) / (2.0 * p->small_time);
}

int pose_next(pose_reader *p)
{
    const int more = reader_next(&p->rows);
    if (more <= 0) return more;
    const double *row = p->rows.row, *q = row + 1;
    pose_set(p, row[0], q, q + p->simulation.system->n);
    return 1;
}

void pose_close(pose_reader *p)
{
    if (p->is_open) reader_close(&p->rows);
    dal_evaluator_free(p->evaluator);
    free(p->q);
    free(p->exact);
    simulation_free(&p->simulation);
    run_directory_close(&p->dir);
}
