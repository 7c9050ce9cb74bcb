/* report_motion.c - the motion of a run at equal intervals of time.
 *
 * Between two rows a number x of the pose is the cubic with the values and the rates at both ends,
 *
 *     x(t0 + s d) = x0 (1 + 2s)(1 - s)^2 + x0' d s (1 - s)^2 + x1 s^2 (3 - 2s) - x1' d s^2 (1 - s),
 *
 * (an angular velocity is linear, as its rate is not known)
 * unless the rows are so far apart that they do not show the motion: then the frames are between
 * the last steps, of which a run with many more steps than rows keeps some, or else the rows. */
#include "report_motion.h"
#include "ui/memory.h"
#include "ui/message.h"

#include "io/csv_table.h"
#include "io/file.h"
#include "report_body.h"
#include "report_page.h"
#include "report_pose.h"
#include "report_rows.h"

#include <math.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

/* Of more rows than these every k-th is read; frames between two rows; what is far off, as a
 * fraction of the extent of the path, and in radians; between rows a body makes less than a quarter
 * of a turn. */
enum { MAX_ROWS = 20000, FRAMES_A_ROW = 8 };
static const double far_fraction = 0.1, far_turn = 0.5, quarter = 1.5707963267948966;

/* Of the mean time between steps: what a difference of poses is taken over. */
static const double small_fraction = 1e-4;

typedef struct pose_row {
    double t, pose[DAL_PICTURE_COUNT], rate[DAL_PICTURE_COUNT];
} pose_row;

/* ---- reading ------------------------------------------------------------------------------- */

static bool is_finite(const pose_reader *p)
{
    double sum = 0.0;
    for (int i = 0; i < DAL_PICTURE_COUNT; i++) sum += fabs(p->pose[i]) + fabs(p->rate[i]);
    return isfinite(sum);
}

typedef struct motion_rows {
    pose_row *row;    /* [MAX_ROWS + 1] */
    int count, steps; /* the last steps, 0: rows */
} motion_rows;

static void keep_row(motion_rows *m, const pose_reader *p)
{
    pose_row *row = &m->row[m->count++];
    row->t = p->t;
    memcpy(row->pose, p->pose, sizeof p->pose);
    memcpy(row->rate, p->rate, sizeof p->rate);
}

/* Reads the rows up to the first that has no pose. */
static int read_rows(pose_reader *p, motion_rows *m)
{
    const long long stride = 1 + p->rows.count / MAX_ROWS;
    int more;
    for (long long k = 0; (more = pose_next(p)) > 0 && is_finite(p); k++) {
        if (k % stride == 0 || k == p->rows.count - 1) keep_row(m, p);
    }
    return more < 0 ? CLI_IO : CLI_DONE;
}

/* Takes the last steps in place of the rows, where the run keeps some. */
static int read_last_steps(pose_reader *p, motion_rows *m, const char *run)
{
    const int n = p->simulation.system->n;
    csv_table summary = {.text = NULL};
    row_steps steps = {.statistics = NULL};
    char *path = cli_join(run, "summary.csv");
    int status = file_exists(path) ? csv_table_read(&summary, path) : CLI_DONE;
    if (status == CLI_DONE) status = row_steps_read(&steps, &p->dir, n, summary.rows - 1);
    const step_record *record = &steps.record;
    const int count = record->number ? record_last_steps(record) : 0;
    double *state = cli_calloc(2 * (size_t)n, sizeof *state);
    if (count > 1) {
        const double passed = record_value(record, 0, count - 1) - record_value(record, 0, 0);
        p->small_time = small_fraction * passed / (count - 1);
        m->count = 0;
        m->steps = count;
    }
    for (int k = 0; k < count && count > 1; k++) {
        for (int i = 0; i < 2 * n; i++) state[i] = record_value(record, 1 + i, k);
        pose_set(p, record_value(record, 0, k), state, state + n);
        if (!is_finite(p)) break;
        keep_row(m, p);
    }
    free(state);
    row_steps_free(&steps);
    csv_table_free(&summary);
    free(path);
    return status;
}

/* Frames follow each other in t, whatever the direction of the run. */
static void order_in_time(motion_rows *m)
{
    pose_row *row = m->row;
    if (row[0].t < row[m->count - 1].t) return;
    for (int i = 0, k = m->count - 1; i < k; i++, k--) {
        const pose_row swapped = row[i];
        row[i] = row[k];
        row[k] = swapped;
    }
}

static double find_extent(const double *first, size_t stride, int count)
{
    double extent = 0.0;
    for (int k = 0; k < 2; k++) {
        double low = INFINITY, high = -INFINITY;
        for (int i = 0; i < count; i++) {
            low = fmin(low, first[(size_t)i * stride + (size_t)k]);
            high = fmax(high, first[(size_t)i * stride + (size_t)k]);
        }
        extent = fmax(extent, high - low);
    }
    return extent;
}

/* The pose at a time between two rows. */
static void interpolate(const pose_row *a, const pose_row *b, double t, double *pose)
{
    const double d = b->t - a->t, s = d > 0.0 ? (t - a->t) / d : 0.0, u = 1.0 - s;
    for (int i = 0; i < DAL_PICTURE_COUNT; i++)
        pose[i] = i >= DAL_PICTURE_WX
                      ? a->pose[i] * u + b->pose[i] * s
                      : a->pose[i] * (1.0 + 2.0 * s) * u * u + a->rate[i] * d * s * u * u +
                            b->pose[i] * s * s * (3.0 - 2.0 * s) - b->rate[i] * d * s * s * u;
}

/* Whether the rows are close enough for the cubics: at nine of ten rows the cubic between both
 * neighbours, at twice the distance and with some sixteen times the error, is not far off. */
static bool is_dense(const pose_row *row, int count)
{
    if (count < 2) return false;
    const double far = far_fraction * find_extent(row->pose, sizeof *row / sizeof(double), count);
    int gaps = 0;
    for (int i = 1; i + 1 < count; i++) {
        double pose[DAL_PICTURE_COUNT];
        const double *at = row[i].pose, passed = fabs(row[i + 1].t - row[i].t);
        interpolate(&row[i - 1], &row[i + 1], row[i].t, pose);
        const double turned =
            hypot(hypot(at[DAL_PICTURE_WX], at[DAL_PICTURE_WY]), at[DAL_PICTURE_WZ]) * passed;
        gaps += hypot(pose[0] - at[0], pose[1] - at[1]) > far || turned > quarter ||
                fabs(pose[DAL_PICTURE_ANGLE] - at[DAL_PICTURE_ANGLE]) > far_turn;
    }
    return 10 * gaps <= count;
}

static void allocate_frames(motion *m, int frames)
{
    m->frames = frames;
    m->t = cli_calloc((size_t)frames, sizeof *m->t);
    m->pose = cli_calloc((size_t)frames, sizeof *m->pose);
}

static void make_frames(motion *m, const motion_rows *rows, int max_frames)
{
    const pose_row *row = rows->row;
    const int count = rows->count;
    m->is_smooth = is_dense(row, count);
    const int frames = m->is_smooth ? FRAMES_A_ROW * (count - 1) + 1 : count;
    allocate_frames(m, frames < max_frames ? frames : max_frames);
    m->start = row[0].t;
    m->end = row[count - 1].t;
    for (int f = 0, i = 0; f < m->frames; f++) {
        const pose_row *at = &row[(long long)f * (count - 1) / (m->frames - 1)];
        m->t[f] = m->is_smooth ? m->start + (m->end - m->start) * f / (m->frames - 1) : at->t;
        while (i + 2 < count && row[i + 1].t <= m->t[f]) i++;
        if (m->is_smooth)
            interpolate(&row[i], &row[i + 1], m->t[f], m->pose[f]);
        else
            memcpy(m->pose[f], at->pose, sizeof m->pose[f]);
    }
}

/* The exact solution at the same times, from the first on at which it has a pose and as long as it
 * has. */
static void make_exact(motion *exact, pose_reader *p, const motion *m)
{
    int count = 0;
    *exact = *m;
    snprintf(exact->method, sizeof exact->method, "exact");
    exact->step = 0.0;
    allocate_frames(exact, m->frames);
    for (int f = 0; f < m->frames; f++) {
        if (pose_of_exact(p, m->t[f], exact->pose[count]))
            exact->t[count++] = m->t[f];
        else if (count > 0)
            break;
    }
    exact->frames = count;
    exact->start = exact->t[0];
    exact->end = exact->t[count > 0 ? count - 1 : 0];
}

static void name_motion(motion *m, const pose_reader *p, int steps)
{
    m->body = p->body;
    m->is_plane = p->is_plane;
    for (int k = 0; k < 2; k++) snprintf(m->axis[k], sizeof m->axis[k], "%s", p->axis[k]);
    const char *method = p->simulation.request.text[REQUEST_integrator];
    snprintf(m->method, sizeof m->method, "%s", method ? method : "");
    m->step = p->simulation.request.options.step;
    if (steps > 0) snprintf(m->part, sizeof m->part, "the last %d steps", steps);
}

int motion_read(motion *m, motion *exact, const char *run, int max_frames)
{
    pose_reader p;
    motion_rows rows = {.count = 0};
    *m = (motion){.frames = 0};
    if (exact) *exact = (motion){.frames = 0};
    int status = pose_open(&p, run);
    rows.row = cli_calloc(MAX_ROWS + 1, sizeof *rows.row);
    if (status == CLI_DONE && p.has_poses) status = read_rows(&p, &rows);
    if (status == CLI_DONE && p.is_open && !is_dense(rows.row, rows.count))
        status = read_last_steps(&p, &rows, run);
    if (rows.count > 1) {
        name_motion(m, &p, rows.steps);
        order_in_time(&rows);
        make_frames(m, &rows, max_frames);
        if (exact && p.has_exact) make_exact(exact, &p, m);
    }
    free(rows.row);
    pose_close(&p);
    return status;
}

void motion_free(motion *m)
{
    free(m->t);
    free(m->pose);
    *m = (motion){.frames = 0};
}

double motion_extent(const motion *m)
{
    return m->frames ? find_extent(m->pose[0], DAL_PICTURE_COUNT, m->frames) : 0.0;
}

/* ---- writing ------------------------------------------------------------------------------- */

/* A number of all frames: [LOW, HIGH, BASE64], or [LOW] of one that does not change. */
static void write_numbers(json_writer *data, const motion *m, int which, const char *name)
{
    double low = INFINITY, high = -INFINITY;
    for (int f = 0; f < m->frames; f++) {
        low = fmin(low, m->pose[f][which]);
        high = fmax(high, m->pose[f][which]);
    }
    json_open_list(data, name, JSON_ON_ONE_LINE);
    json_put_rounded(data, NULL, low);
    if (high > low) {
        uint16_t *level = cli_calloc((size_t)m->frames, sizeof *level);
        for (int f = 0; f < m->frames; f++)
            level[f] = (uint16_t)lround((m->pose[f][which] - low) / (high - low) * UINT16_MAX);
        json_put_rounded(data, NULL, high);
        report_put_levels(data, NULL, level, m->frames);
        free(level);
    }
    json_close(data);
}

static void write_pair(json_writer *data, const char *name, const double pair[2])
{
    json_open_list(data, name, JSON_ON_ONE_LINE);
    json_put_rounded(data, NULL, pair[0]);
    json_put_rounded(data, NULL, pair[1]);
    json_close(data);
}

static void write_shape(json_writer *data, const body_shape *shape)
{
    json_open(data, NULL, JSON_ON_ONE_LINE);
    write_pair(data, "pivot", shape->pivot);
    json_put_rounded(data, "turn", shape->turn);
    json_put_bool(data, "narrowed", shape->is_narrowed);
    json_put_rounded(data, "radius", shape->radius);
    json_open_list(data, "line", JSON_ON_ONE_LINE);
    for (int i = 0; i < shape->count; i++) write_pair(data, NULL, shape->at[i]);
    json_close(data);
    json_close(data);
}

void motion_write(json_writer *data, const motion *m)
{
    static const char *const names[] = {
#define NUMBER_NAME(code, name) name,
        DAL_PICTURE_LIST(NUMBER_NAME)
#undef NUMBER_NAME
    };
    json_open(data, NULL, JSON_ON_ONE_LINE);
    json_put_text(data, "integrator", m->method);
    json_put_rounded(data, "step", m->step);
    if (m->part[0]) json_put_text(data, "part", m->part);
    json_put_rounded(data, "start", m->start);
    json_put_rounded(data, "end", m->end);
    json_put_integer(data, "frames", m->frames);
    json_put_bool(data, "smooth", m->is_smooth);
    json_put_bool(data, "plane", m->is_plane);
    json_open_list(data, "axes", JSON_ON_ONE_LINE);
    for (int i = 0; i < 2; i++) json_put_text(data, NULL, m->axis[i]);
    json_close(data);
    json_put_text(data, "body", body_name[m->body]);
    json_open_list(data, "parts", JSON_ON_ONE_LINE);
    for (const body_shape *shape = NULL; (shape = body_next(m->body, shape));)
        write_shape(data, shape);
    json_close(data);
    for (int i = 0; i < DAL_PICTURE_COUNT; i++) write_numbers(data, m, i, names[i]);
    json_close(data);
}
