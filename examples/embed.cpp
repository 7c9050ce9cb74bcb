// embed.cpp - the stepper of embed.c inside a C++ program: objects free themselves, failures throw.
//
//     c++ -std=c++17 embed.cpp $(pkg-config --cflags --libs dalembert) -o embed
//
// Prints t, q, v and the constraint D ten times on the way to t = 10.
#include <cstdio>
#include <dalembert.h>
#include <memory>
#include <stdexcept>
#include <string>

struct Free {
    void operator()(dal_model *model) const { dal_model_free(model); }
    void operator()(dal_run *run) const { dal_run_free(run); }
};

static void check(dal_status status, const dal_error &error)
{
    if (status) throw std::runtime_error(std::string(dal_status_text(status)) + ": " + error.message);
}

static void print_motion()
{
    dal_error error;
    dal_model *model;
    check(dal_model_builtin(&model, "chaplygin-sleigh", &error), error);
    const std::unique_ptr<dal_model, Free> owned_model(model);

    dal_run_spec spec{};
    spec.options = dal_options_default();
    spec.options.step = 0.01;
    check(dal_model_system(model, &spec.system, &error), error);
    check(dal_method_parse(&spec.method, "gauss4+project", &error), error);
    dal_run *run;
    check(dal_run_create(&run, &spec, &error), error);
    const std::unique_ptr<dal_run, Free> owned_run(run);

    for (int row = 0; row < 10; row++) {
        double seen[16]; // the sleigh has fewer observables; D is the first
        check(dal_run_advance(run, 100, &error), error);
        dal_run_observe(run, seen);
        std::printf("%.17g", dal_run_time(run));
        for (int i = 0; i < 2 * spec.system->n; i++) std::printf(" %.17g", dal_run_state(run)[i]);
        std::printf(" %.3g\n", seen[0]);
    }
}

int main()
{
    try {
        print_motion();
    } catch (const std::exception &failure) {
        std::fprintf(stderr, "embed: %s\n", failure.what());
        return 1;
    }
}
