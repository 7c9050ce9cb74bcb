/* report_motion.c - the motion of a run at equal intervals of time.
 *
 * Between two rows a number x of the pose is the cubic with the values and the rates at both ends,
 *
 *     x(t0 + s d) = x0 (1 + 2s)(1 - s)^2 + x0' d s (1 - s)^2 + x1 s^2 (3 - 2s) - x1' d s^2 (1 - s),
 *
 * (an angular velocity is linear, as its rate is not known)
 * unless the rows are so far apart that they do not show the path: then the rows are the frames. */
#include "report_motion.h"
#include "ui/memory.h"
#include "ui/message.h"

#include "report_body.h"
#include "report_page.h"
#include "report_pose.h"

#include <math.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

/* Of more rows than these every k-th is read; frames between two rows; what is far off, as
 * a part of the extent of the path. */
enum { MAX_ROWS = 20000, FRAMES_A_ROW = 8 };
static const double far_part = 0.1;

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

/* Reads the rows up to the first that has no pose; their number, or -1. */
static int read_rows(pose_reader *p, pose_row *row)
{
    const long long stride = 1 + p->rows.count / MAX_ROWS;
    int more, count = 0;
    for (long long k = 0; (more = pose_next(p)) > 0 && is_finite(p); k++) {
        if (k % stride && k != p->rows.count - 1) continue;
        row[count].t = p->t;
        memcpy(row[count].pose, p->pose, sizeof p->pose);
        memcpy(row[count++].rate, p->rate, sizeof p->rate);
    }
    return more < 0 ? -1 : count;
}

/* Frames follow each other in t, whatever the direction of the run. */
static void order_in_time(pose_row *row, int count)
{
    if (row[0].t < row[count - 1].t) return;
    for (int i = 0, k = count - 1; i < k; i++, k--) {
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
    const double far = far_part * find_extent(row->pose, sizeof *row / sizeof(double), count);
    int gaps = 0;
    for (int i = 1; i + 1 < count; i++) {
        double pose[DAL_PICTURE_COUNT];
        interpolate(&row[i - 1], &row[i + 1], row[i].t, pose);
        gaps += hypot(pose[0] - row[i].pose[0], pose[1] - row[i].pose[1]) > far;
    }
    return 10 * gaps <= count;
}

static void make_frames(motion *m, const pose_row *row, int count, int max_frames)
{
    m->is_smooth = is_dense(row, count);
    m->frames = m->is_smooth ? FRAMES_A_ROW * (count - 1) + 1 : count;
    if (m->frames > max_frames) m->frames = max_frames;
    m->start = row[0].t;
    m->end = row[count - 1].t;
    m->pose = cli_calloc((size_t)m->frames, sizeof *m->pose);
    for (int f = 0, i = 0; f < m->frames; f++) {
        const double t = m->start + (m->end - m->start) * f / (m->frames - 1);
        while (i + 2 < count && row[i + 1].t <= t) i++;
        if (m->is_smooth)
            interpolate(&row[i], &row[i + 1], t, m->pose[f]);
        else
            memcpy(m->pose[f], row[(long long)f * (count - 1) / (m->frames - 1)].pose,
                   sizeof m->pose[f]);
    }
}

int motion_read(motion *m, const char *run, int max_frames)
{
    pose_reader p;
    *m = (motion){.frames = 0};
    int status = pose_open(&p, run);
    if (status == CLI_DONE && p.has_poses) {
        pose_row *row = cli_calloc(MAX_ROWS + 1, sizeof *row);
        const int count = read_rows(&p, row);
        if (count < 0) status = CLI_IO;
        m->body = p.body;
        m->is_plane = p.is_plane;
        for (int k = 0; k < 2; k++) snprintf(m->axis[k], sizeof m->axis[k], "%s", p.axis[k]);
        const char *method = p.simulation.request.text[REQUEST_integrator];
        snprintf(m->method, sizeof m->method, "%s", method ? method : "");
        m->step = p.simulation.request.options.step;
        if (count > 1) order_in_time(row, count);
        if (count > 1) make_frames(m, row, count, max_frames);
        free(row);
    }
    pose_close(&p);
    return status;
}

void motion_free(motion *m)
{
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

static void write_part(json_writer *data, const body_part *part)
{
    json_open(data, NULL, JSON_ON_ONE_LINE);
    write_pair(data, "pivot", part->pivot);
    json_put_rounded(data, "turn", part->turn);
    json_put_flag(data, "narrowed", part->is_narrowed);
    json_put_rounded(data, "radius", part->radius);
    json_open_list(data, "line", JSON_ON_ONE_LINE);
    for (int i = 0; i < part->count; i++) write_pair(data, NULL, part->at[i]);
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
    json_put_text(data, "method", m->method);
    json_put_rounded(data, "step", m->step);
    json_put_rounded(data, "start", m->start);
    json_put_rounded(data, "end", m->end);
    json_put_integer(data, "frames", m->frames);
    json_put_flag(data, "smooth", m->is_smooth);
    json_put_flag(data, "plane", m->is_plane);
    json_open_list(data, "axes", JSON_ON_ONE_LINE);
    for (int i = 0; i < 2; i++) json_put_text(data, NULL, m->axis[i]);
    json_close(data);
    json_put_text(data, "body", body_name[m->body]);
    json_open_list(data, "parts", JSON_ON_ONE_LINE);
    for (const body_part *part = NULL; (part = body_next(m->body, part));) write_part(data, part);
    json_close(data);
    for (int i = 0; i < DAL_PICTURE_COUNT; i++) write_numbers(data, m, i, names[i]);
    json_close(data);
}
