/* report_path.c - the path of a run in the plane, and its body at some instants.
 *
 * A system file defines under `picture` where the body is and which one it is.  Its outline here
 * has a length of 2, heading along x, and is drawn at a size that suits the path. */
#include "report_path.h"
#include "dalembert.h"
#include "ui/memory.h"
#include "ui/message.h"

#include "io/trajectory.h"
#include "report_plot.h"
#include "run/columns.h"
#include "run/manifest.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

/* Of more rows than MAX_POINTS every k-th is drawn; instants of the body; its half length as a part
 * of the extent of the path; points of a circle. */
enum { MAX_POINTS = 2000, INSTANTS = 9, ROUND = 32 };
static const double half_length = 0.055;
static const double pi = 3.14159265358979323846;

typedef struct body_path {
    run_directory dir;
    run_request request;
    trajectory_reader reader;
    dal_evaluator *evaluator;
    double pose[INSTANTS][DAL_PICTURE_COUNT];
    int poses;
    double low[2], high[2];
} body_path;

/* ---- outlines ------------------------------------------------------------------------------ */

typedef struct pen {
    const report_plot *plot;
    plot_curve *curve;
    const double *pose;
    double scale;
} pen;

/* A point of the outline: turned, moved, in the plane. */
static void draw_to(const pen *p, double x, double y)
{
    const double c = cos(p->pose[DAL_PICTURE_ANGLE]), s = sin(p->pose[DAL_PICTURE_ANGLE]);
    report_point(p->plot, p->curve, p->pose[DAL_PICTURE_X] + p->scale * (c * x - s * y),
                 p->pose[DAL_PICTURE_Y] + p->scale * (s * x + c * y));
}

static void draw_line(const pen *p, const double (*at)[2], int count)
{
    for (int i = 0; i < count; i++) draw_to(p, at[i][0], at[i][1]);
    report_lift(p->curve);
}

static void draw_ellipse(const pen *p, double a, double b)
{
    for (int i = 0; i <= ROUND; i++)
        draw_to(p, a * cos(2.0 * pi * i / ROUND), b * sin(2.0 * pi * i / ROUND));
    report_lift(p->curve);
}

/* Two wheels at the ends of an axle about (x, y), which roll along the angle turn. */
static void draw_axle(const pen *p, double x, double y, double turn)
{
    const double c = cos(turn), s = sin(turn), wide = 0.45, wheel = 0.3;
    const double axle[][2] = {{x - wide * s, y + wide * c}, {x + wide * s, y - wide * c}};
    draw_line(p, axle, 2);
    for (int k = 0; k < 2; k++) {
        const double ends[][2] = {{axle[k][0] - wheel * c, axle[k][1] - wheel * s},
                                  {axle[k][0] + wheel * c, axle[k][1] + wheel * s}};
        draw_line(p, ends, 2);
    }
}

/* The lines of a body that do not change. */
static const struct {
    dal_body body;
    int count;
    double at[6][2];
} outlines[] = {
    {DAL_BODY_BLADE, 2, {{-1, 0}, {1, 0}}},
    {DAL_BODY_BLADE, 3, {{0.5, 0.3}, {1, 0}, {0.5, -0.3}}},
    {DAL_BODY_SLEIGH,
     6,
     {{1.2, 0}, {0.4, 0.55}, {-0.9, 0.55}, {-0.9, -0.55}, {0.4, -0.55}, {1.2, 0}}},
    {DAL_BODY_SLEIGH, 2, {{-0.5, 0}, {0.5, 0}}},
    {DAL_BODY_DISK, 2, {{0, -0.35}, {0, 0.35}}}, /* the axle: upright, the disk is a line */
    {DAL_BODY_ROBOT, 2, {{0, 0}, {0.9, 0}}},
    {DAL_BODY_BOARD, 2, {{-1, 0}, {1, 0}}},
};

static void draw_body(const pen *p, dal_body body)
{
    static const double radius[DAL_BODY_COUNT] = {[DAL_BODY_POINT] = 0.3,
                                                  [DAL_BODY_DISK] = 1.0,
                                                  [DAL_BODY_BALL] = 0.7,
                                                  [DAL_BODY_ROBOT] = 0.9};
    const double r = radius[body], steer = p->pose[DAL_PICTURE_STEER];
    if (r > 0.0) draw_ellipse(p, r, body == DAL_BODY_DISK ? p->pose[DAL_PICTURE_WIDTH] : r);
    for (size_t i = 0; i < sizeof outlines / sizeof outlines[0]; i++)
        if (outlines[i].body == body) draw_line(p, outlines[i].at, outlines[i].count);
    if (body == DAL_BODY_BOARD) {
        draw_axle(p, 1.0, 0.0, steer);
        draw_axle(p, -1.0, 0.0, -steer);
    } else if (body == DAL_BODY_RACER) {
        const double arm = 0.7, end[2] = {1.2 + arm * cos(steer), arm * sin(steer)};
        const double frame[][2] = {{0, 0}, {1.2, 0}, {end[0], end[1]}};
        draw_line(p, frame, 3);
        draw_axle(p, 0.0, 0.0, 0.0);
        draw_axle(p, end[0], end[1], steer);
    }
}

static void draw_bodies(const body_path *p, report_plot *plot)
{
    const double extent = fmax(p->high[0] - p->low[0], p->high[1] - p->low[1]);
    plot_curve *curve = report_curve(plot, "");
    curve->is_black = true;
    for (int k = 0; k < p->poses; k++)
        draw_body(&(pen){plot, curve, p->pose[k], extent > 0.0 ? half_length * extent : 1.0},
                  p->request.system->picture->body);
}

/* ---- the path ------------------------------------------------------------------------------ */

/* The present row, number k. */
static void add_row(body_path *p, const report_plot *plot, plot_curve *curve, long long k)
{
    const long long stride = 1 + p->reader.count / MAX_POINTS, last = p->reader.count - 1;
    const bool is_instant = p->poses < INSTANTS && k >= last * p->poses / (INSTANTS - 1);
    const dal_system *system = p->request.system;
    const double *row = p->reader.row;
    double at[DAL_PICTURE_COUNT];
    if (!is_instant && k % stride && k != last) return;
    if (dal_evaluator_call(p->evaluator, system->picture->evaluate, row[0], row + 1,
                           row + 1 + system->n, NULL, at))
        return;
    report_point(plot, curve, at[DAL_PICTURE_X], at[DAL_PICTURE_Y]);
    for (int i = 0; i < 2; i++) {
        p->low[i] = fmin(p->low[i], at[i]);
        p->high[i] = fmax(p->high[i], at[i]);
    }
    if (is_instant) memcpy(p->pose[p->poses++], at, sizeof at);
}

static int draw_path(body_path *p, report *r, const char *name, const char *caption)
{
    static const char *const words[] = {
#define BODY_WORD(code, word) word,
        DAL_BODY_LIST(BODY_WORD)
#undef BODY_WORD
    };
    const dal_body body = p->request.system->picture->body;
    char text[2 * PLOT_NAME] = "", title[PLOT_NAME];
    int more, status = CLI_DONE;
    report_plot plot = {
        .name = name, .title = title, .xlabel = "x", .ylabel = "y", .is_to_scale = true};
    snprintf(title, sizeof title, body == DAL_BODY_POINT ? "Path" : "Path of the %s", words[body]);
    plot_curve *curve = report_curve(&plot, "");
    for (long long k = 0; (more = reader_next(&p->reader)) > 0; k++) add_row(p, &plot, curve, k);
    if (more < 0) status = CLI_IO;
    /* Where rows are far apart the lines between them are not the path. */
    const double far = 0.2 * fmax(p->high[0] - p->low[0], p->high[1] - p->low[1]);
    int gaps = 0;
    for (int i = 1; i < curve->count; i++)
        gaps += hypot(curve->at[i][0] - curve->at[i - 1][0],
                      curve->at[i][1] - curve->at[i - 1][1]) > far;
    curve->has_dots = 10 * gaps > curve->count;
    draw_bodies(p, &plot);
    if (p->poses > 0 && body != DAL_BODY_POINT)
        snprintf(text, sizeof text, "The %s, not to scale, at %d of the rows.", words[body],
                 p->poses);
    char *whole = cli_format("%s%s%s", caption, caption[0] && p->poses > 0 ? " " : "", text);
    plot.caption = whole;
    const int drawn = report_draw(r, &plot);
    free(whole);
    return status == CLI_DONE ? drawn : status;
}

/* The run as its directory describes it, which may be gone: a study does not need it. */
static int open_path(body_path *p, const char *run)
{
    dal_run_spec spec;
    dal_error error;
    run_directory_open(&p->dir, run);
    if (access(p->dir.manifest, F_OK) != 0) return CLI_DONE;
    int status = manifest_read(&p->dir, &p->request);
    if (status == CLI_DONE) status = request_make_spec(&p->request, &spec);
    if (status != CLI_DONE || !p->request.system->picture) return status;
    if (dal_evaluator_create(&p->evaluator, p->request.system, p->request.set.item,
                             p->request.set.count, &error))
        return cli_error(CLI_USAGE, run, &error);
    return reader_open(&p->reader, run);
}

/* A path needs all of q and v, which a run with --columns may not have. */
static bool has_state(const body_path *p)
{
    const dal_system *system = p->request.system;
    const int n = system->n;
    if (p->reader.columns <= 2 * n) return false;
    for (int i = 0; i < n; i++) {
        const char *coordinate = system->coordinate[i], *velocity = p->reader.name[1 + n + i];
        if (strcmp(p->reader.name[1 + i], coordinate) != 0 ||
            !columns_is_velocity(&p->request, velocity, coordinate))
            return false;
    }
    return true;
}

int report_path(report *r, const char *run, const char *name, const char *caption)
{
    body_path p = {.request = request_default(),
                   .dir = {.descriptor = -1},
                   .low = {INFINITY, INFINITY},
                   .high = {-INFINITY, -INFINITY}};
    int status = open_path(&p, run);
    if (status == CLI_DONE && p.evaluator) {
        if (p.reader.count > 0 && has_state(&p)) status = draw_path(&p, r, name, caption);
        reader_close(&p.reader);
    }
    dal_evaluator_free(p.evaluator);
    request_free(&p.request);
    run_directory_close(&p.dir);
    return status;
}
