/* report_path.c - the path of a run in the plane, and its body at some instants, drawn at a size
 * that suits the path. */
#include "report_path.h"
#include "ui/memory.h"
#include "ui/message.h"

#include "report_body.h"
#include "report_plot.h"
#include "report_pose.h"
#include "report_rows.h"
#include "run/event_log.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Of more rows than MAX_POINTS every k-th is drawn, and of more dots than MAX_DOTS every k-th;
 * instants of the body; its half length as a fraction of the extent of the path; points of a
 * circle. */
enum { MAX_POINTS = 2000, MAX_DOTS = 500, INSTANTS = 9, ROUND = 32 };
static const double half_length = 0.055;
static const double pi = 3.14159265358979323846;

typedef struct body_path {
    pose_reader poses;
    double pose[INSTANTS][DAL_PICTURE_COUNT];
    int instants;
    double low[2], high[2];
    row_distance distance[2];
} body_path;

/* ---- outlines ------------------------------------------------------------------------------ */

typedef struct pen {
    const report_plot *plot;
    plot_curve *curve;
    const double *pose;
    double scale;
} pen;

/* A point of a shape: narrowed, turned about its pivot, with the body in the plane. */
static void draw_to(const pen *p, const body_shape *shape, double x, double y)
{
    const double turn = shape->turn * p->pose[DAL_PICTURE_STEER];
    const double c = cos(p->pose[DAL_PICTURE_ANGLE]), s = sin(p->pose[DAL_PICTURE_ANGLE]);
    if (shape->is_narrowed) y *= p->pose[DAL_PICTURE_WIDTH];
    const double u = shape->pivot[0] + cos(turn) * x - sin(turn) * y;
    const double v = shape->pivot[1] + sin(turn) * x + cos(turn) * y;
    report_point(p->plot, p->curve, p->pose[DAL_PICTURE_X] + p->scale * (c * u - s * v),
                 p->pose[DAL_PICTURE_Y] + p->scale * (s * u + c * v));
}

static void draw_shape(const pen *p, const body_shape *shape)
{
    const double r = shape->radius;
    for (int i = 0; i < shape->count; i++) draw_to(p, shape, shape->at[i][0], shape->at[i][1]);
    for (int i = 0; r > 0.0 && i <= ROUND; i++)
        draw_to(p, shape, r * cos(2.0 * pi * i / ROUND), r * sin(2.0 * pi * i / ROUND));
    report_lift(p->curve);
}

static void draw_bodies(const body_path *p, report_plot *plot)
{
    const double extent = fmax(p->high[0] - p->low[0], p->high[1] - p->low[1]);
    plot_curve *curve = report_curve(plot, "");
    curve->is_black = true;
    for (int k = 0; k < p->instants; k++) {
        const pen ink = {plot, curve, p->pose[k], extent > 0.0 ? half_length * extent : 1.0};
        for (const body_shape *shape = NULL; (shape = body_next(p->poses.body, shape));)
            draw_shape(&ink, shape);
    }
}

/* ---- the path ------------------------------------------------------------------------------ */

/* The present row, number k. */
static void add_row(body_path *p, const report_plot *plot, plot_curve *curve, long long k)
{
    const long long stride = 1 + p->poses.rows.count / MAX_POINTS, last = p->poses.rows.count - 1;
    const bool is_instant = p->instants < INSTANTS && k >= last * p->instants / (INSTANTS - 1);
    const double *at = p->poses.pose;
    for (int i = 0; i < 2; i++)
        row_distance_add(&p->distance[i], p->poses.t, at[i], p->poses.rate[i]);
    if ((!is_instant && k % stride && k != last) || isnan(at[DAL_PICTURE_X])) return;
    report_point(plot, curve, at[DAL_PICTURE_X], at[DAL_PICTURE_Y]);
    for (int i = 0; i < 2; i++) {
        p->low[i] = fmin(p->low[i], at[i]);
        p->high[i] = fmax(p->high[i], at[i]);
    }
    if (is_instant) memcpy(p->pose[p->instants++], at, sizeof p->poses.pose);
}

/* Makes dots of a path where rows are so far apart that the lines between them are not the path. */
static void break_path(const body_path *p, plot_curve *curve)
{
    const double far = 0.2 * fmax(p->high[0] - p->low[0], p->high[1] - p->low[1]);
    const int stride = 1 + curve->count / MAX_DOTS;
    int gaps = 0, kept = 0;
    for (int i = 1; i < curve->count; i++)
        gaps += hypot(curve->at[i][0] - curve->at[i - 1][0],
                      curve->at[i][1] - curve->at[i - 1][1]) > far;
    curve->has_dots = 10 * gaps > curve->count || row_distance_is_sparse(&p->distance[0]) ||
                      row_distance_is_sparse(&p->distance[1]);
    if (!curve->has_dots) return;
    for (int i = 0; i < curve->count; i += stride)
        memmove(curve->at[kept++], curve->at[i], sizeof curve->at[i]);
    curve->count = kept;
}

/* Rings where the events happened, the first of them. */
static int draw_events(body_path *p, report_plot *plot)
{
    double pose[DAL_PICTURE_COUNT];
    const int n = p->poses.simulation.system->n;
    event_reader events;
    const int status = event_reader_open(&events, p->poses.dir.events, 2 * n);
    plot_curve *curve = report_curve(plot, "events");
    curve->has_rings = true;
    curve->colour = 1;
    while (curve->count < MAX_DOTS && event_reader_next(&events)) {
        pose_of(&p->poses, events.t, events.state, events.state + n, pose);
        report_point(plot, curve, pose[DAL_PICTURE_X], pose[DAL_PICTURE_Y]);
    }
    event_reader_close(&events);
    if (curve->count == 0) plot->count--;
    return status;
}

static int draw_path(body_path *p, report *r, const char *name, const char *caption)
{
    const dal_body body = p->poses.body;
    char text[2 * PLOT_NAME] = "", title[PLOT_NAME];
    int more, status = CLI_DONE;
    report_plot plot = {.name = name,
                        .title = title,
                        .xlabel = p->poses.axis[0],
                        .ylabel = p->poses.axis[1],
                        .is_to_scale = true};
    snprintf(title, sizeof title, body == DAL_BODY_POINT ? "Path" : "Path of the %s",
             body_name[body]);
    plot_curve *curve = report_curve(&plot, "");
    for (long long k = 0; (more = pose_next(&p->poses)) > 0; k++) add_row(p, &plot, curve, k);
    if (more < 0) status = CLI_IO;
    const bool moves = body != DAL_BODY_BOX || p->high[0] > p->low[0] || p->high[1] > p->low[1];
    if (!moves) curve->count = 0; /* a body that turns in its place has no path */
    break_path(p, curve);
    if (moves) draw_bodies(p, &plot);
    if (status == CLI_DONE) status = draw_events(p, &plot);
    if (p->instants > 0 && body != DAL_BODY_POINT)
        snprintf(text, sizeof text, "The %s, not to scale, at %d of the rows.", body_name[body],
                 p->instants);
    char *whole = cli_format("%s%s%s", caption, caption[0] && p->instants > 0 ? " " : "", text);
    plot.caption = whole;
    const int drawn = report_draw(r, &plot);
    free(whole);
    return status == CLI_DONE ? drawn : status;
}

int report_path(report *r, const char *run, const char *name, const char *caption)
{
    body_path p = {.low = {INFINITY, INFINITY}, .high = {-INFINITY, -INFINITY}};
    int status = pose_open(&p.poses, run);
    if (status == CLI_DONE && p.poses.has_poses && p.poses.is_plane)
        status = draw_path(&p, r, name, caption);
    pose_close(&p.poses);
    return status;
}
