/* heyoka.cpp - heyoka 7, a peer of tolerances.c; both measure the same motions.
 *
 *     heyoka find heyoka SYSTEM LANES ERROR             the largest tolerance that reaches the error
 *     heyoka time heyoka SYSTEM LANES ERROR TOLERANCE   nanoseconds of a trajectory
 *
 * The equations are in fields.hpp.  Lanes are a batch of heyoka's, in registers as wide as the
 * machine has them.  Timed are the fastest of those flags that reach the error. */
#define _POSIX_C_SOURCE 200809L
#include "../tolerances.h"
#include "fields.hpp"

#include <cstdint>
#include <heyoka/expression.hpp>
#include <heyoka/kw.hpp>
#include <heyoka/math/cos.hpp>
#include <heyoka/math/sin.hpp>
#include <heyoka/taylor.hpp>
#include <memory>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

using heyoka::expression;
using field = void (*)(const expression *y, expression *dy);

/* One lane, or a batch: one of the two is there. */
struct contender {
    bench_reference reference;
    int lanes;
    field f;
    std::unique_ptr<heyoka::taylor_adaptive<double>> single;
    std::unique_ptr<heyoka::taylor_adaptive_batch<double>> batch;
    bench_states end;
};

struct flags {
    bool fast_math, slp_vectorize, compact_mode;
};
static const flags plain{false, false, false};
static const flags choices[] = {
    plain, {true, false, false}, {false, true, false}, {false, false, true}};

static std::vector<std::pair<expression, expression>> equations(field f, int size)
{
    std::vector<std::pair<expression, expression>> all;
    std::vector<expression> y, dy(static_cast<std::size_t>(size));
    for (int i = 0; i < size; i++) y.emplace_back("y" + std::to_string(i));
    f(y.data(), dy.data());
    for (std::size_t i = 0; i < y.size(); i++) all.push_back(heyoka::prime(y[i]) = dy[i]);
    return all;
}

static double *state_of(contender *j)
{
    return j->single ? j->single->get_state_data() : j->batch->get_state_data();
}

/* The state has the lanes of a component side by side. */
static int start_again(void *self)
{
    auto *j = static_cast<contender *>(self);
    for (int i = 0; i < j->reference.size; i++)
        for (int lane = 0; lane < j->lanes; lane++)
            state_of(j)[i * j->lanes + lane] = j->reference.start[lane][i];
    if (j->single) j->single->set_time(0.0);
    if (j->batch) j->batch->set_time(0.0);
    return 0;
}

static int work(void *self, double *end)
{
    auto *j = static_cast<contender *>(self);
    if (j->single) j->single->propagate_until(j->reference.time);
    if (j->batch) j->batch->propagate_until(j->reference.time);
    for (int i = 0; i < j->reference.size; i++) {
        for (int lane = 0; lane < j->lanes; lane++)
            j->end[lane][i] = state_of(j)[i * j->lanes + lane];
        end[i] = j->end[0][i];
    }
    return 0;
}

static void compile(contender *j, double tolerance, const flags &with)
{
    namespace kw = heyoka::kw;
    const auto size = static_cast<std::size_t>(j->reference.size * j->lanes);
    const auto make = [&](auto &integrator, auto... batch_size) {
        using integrator_type =
            typename std::remove_reference_t<decltype(integrator)>::element_type;
        integrator = std::make_unique<integrator_type>(
            equations(j->f, j->reference.size), std::vector<double>(size), batch_size...,
            kw::tol = tolerance, kw::fast_math = with.fast_math,
            kw::slp_vectorize = with.slp_vectorize, kw::compact_mode = with.compact_mode,
            kw::force_avx512 = true);
    };
    if (j->lanes == 1)
        make(j->single);
    else
        make(j->batch, static_cast<std::uint32_t>(j->lanes));
}

static double error_of(void *self, double tolerance)
{
    auto *j = static_cast<contender *>(self);
    double end[BENCH_MAX_MOTION];
    compile(j, tolerance, plain);
    start_again(j);
    work(j, end);
    return bench_error(&j->reference, j->end, j->lanes);
}

static int time_fastest(contender *j, double error, double tolerance)
{
    const bench_contender timed{static_cast<double>(j->lanes), j->reference.size, work, j};
    double end[BENCH_MAX_MOTION], min = INFINITY;
    const flags *fastest = nullptr;
    for (const auto &with : choices) {
        compile(j, tolerance, with);
        bench_time(&timed, start_again, 10, end);
        const double taken = bench_time(&timed, start_again, 100, end);
        if (!(bench_error(&j->reference, j->end, j->lanes) <= error) || taken >= min) continue;
        min = taken;
        fastest = &with;
    }
    if (!fastest) {
        fprintf(stderr, "heyoka: the error is not reached\n");
        return 1;
    }
    compile(j, tolerance, *fastest);
    return bench_measure_from(&timed, start_again);
}

int main(int argc, char **argv)
{
    static contender j;
    const struct {
        const char *name;
        field f;
    } motions[] = {{"A", sleigh<expression>},
                   {"chaotic-oscillators", chaotic_oscillators<expression>},
                   {"falling-disk", falling_disk<expression>}};
    const bool finds = argc == 6 && strcmp(argv[1], "find") == 0;
    const bool times = argc == 7 && strcmp(argv[1], "time") == 0;
    for (const auto &m : motions)
        if ((finds || times) && strcmp(argv[3], m.name) == 0) j.f = m.f;
    j.lanes = j.f ? atoi(argv[4]) : 0;
    if (j.lanes != 1 && j.lanes != BENCH_LANES) return bench_unknown(argc, argv);
    if (bench_read_reference(&j.reference, argv[3])) return 1;
    if (times) return time_fastest(&j, atof(argv[5]), atof(argv[6]));
    bench_find(error_of, &j, atof(argv[5]));
    return 0;
}
