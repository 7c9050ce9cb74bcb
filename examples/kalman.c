/* kalman.c - an extended Kalman filter around a model: the position of a sleigh is measured ten
 * times a second, with errors of 0.05; its heading, which is 0.5 wrong at first, and its velocities
 * are estimated.
 *
 *     z = (q, v),  dz/dt = (v, F),  P -> Phi P Phi^T + Q,  Phi = 1 + h G + h^2/2 G^2,
 *     G = (0 1; F_q F_v)
 *
 * Prints t, the estimates of phi, y1', y2', phi' and the standard deviation of phi. */
#include <dalembert_evaluator.h>
#include <math.h>
#include <stdio.h>

enum { N = 3, Z = 2 * N, MEASURED = 2 };
static const double h = 0.1, deviation = 0.05, diffusion = 1e-5;

/* Moves the covariance P along, by the derivative of F at z. */
static dal_status predict(dal_evaluator *model, double t, const double *z, double P[Z][Z])
{
    double J[N * Z], G[Z][Z] = {{0}}, Phi[Z][Z], moved[Z][Z];
    dal_callback *jacobian = dal_evaluator_system(model)->call.jacobian;
    dal_status status = dal_evaluator_call(model, jacobian, t, z, z + N, NULL, J);
    for (int i = 0; i < N; i++) G[i][N + i] = 1;
    for (int i = 0; i < N * N; i++) {
        G[N + i / N][i % N] = J[i];
        G[N + i / N][N + i % N] = J[N * N + i];
    }
    for (int i = 0; i < Z * Z; i++) {
        Phi[i / Z][i % Z] = (i / Z == i % Z) + h * G[i / Z][i % Z];
        for (int k = 0; k < Z; k++) Phi[i / Z][i % Z] += h * h / 2 * G[i / Z][k] * G[k][i % Z];
    }
    for (int i = 0; i < Z * Z; i++) {
        moved[i / Z][i % Z] = 0;
        for (int k = 0; k < Z; k++) moved[i / Z][i % Z] += Phi[i / Z][k] * P[k][i % Z];
    }
    for (int i = 0; i < Z * Z; i++) {
        P[i / Z][i % Z] = i / Z == i % Z ? diffusion : 0;
        for (int k = 0; k < Z; k++) P[i / Z][i % Z] += moved[i / Z][k] * Phi[i % Z][k];
    }
    return status;
}

/* Takes a measurement of component k into account. */
static void correct(int k, double measured, double *z, double P[Z][Z])
{
    double gain[Z], row[Z];
    const double innovation = measured - z[k], S = P[k][k] + deviation * deviation;
    for (int i = 0; i < Z; i++) gain[i] = P[i][k] / S, row[i] = P[k][i];
    for (int i = 0; i < Z; i++) z[i] += gain[i] * innovation;
    for (int i = 0; i < Z * Z; i++) P[i / Z][i % Z] -= gain[i / Z] * row[i % Z];
}

/* Uniform of variance 1, the same on every machine. */
static double draw(void)
{
    static unsigned long long state = 1;
    state = state * 6364136223846793005ULL + 1442695040888963407ULL;
    return sqrt(12.0) * ((double)(state >> 11) / 9007199254740992.0 - 0.5);
}

int main(void)
{
    const dal_setting start = {"phi", 0.5};
    double z[Z + 1], P[Z][Z] = {{0}}; /* e is after q and v */
    dal_model *model;
    dal_run *run;
    dal_evaluator *evaluator;
    dal_error error;
    dal_run_spec spec = {.options = dal_options_default()};
    spec.options.space = DAL_PHYSICAL;
    spec.options.step = h / 10;
    if (dal_model_builtin(&model, "chaplygin-sleigh", &error) ||
        dal_model_system(model, &spec.system, &error) ||
        dal_method_parse(&spec.method, "gauss4", &error) || dal_run_create(&run, &spec, &error) ||
        dal_evaluator_create(&evaluator, spec.system, NULL, 0, &error) ||
        dal_evaluator_start(evaluator, &start, 1, z, &error)) {
        fprintf(stderr, "kalman: %s\n", error.message);
        return 1;
    }
    for (int i = 0; i < Z; i++) P[i][i] = i < MEASURED ? 0.01 : 0.25;
    for (int cycle = 1; cycle <= 200; cycle++) {
        const double t = cycle * h, true_position[MEASURED] = {sin(t), 1 - cos(t)};
        if (dal_evaluator_project_velocity(evaluator, t - h, z, z + N) ||
            predict(evaluator, t - h, z, P) || dal_run_set_state(run, t - h, z, &error) ||
            dal_run_advance(run, 10, &error))
            return 1;
        for (int i = 0; i < Z; i++) z[i] = dal_run_state(run)[i];
        for (int k = 0; k < MEASURED; k++) correct(k, true_position[k] + deviation * draw(), z, P);
        if (cycle % 20 == 0)
            printf("%g %.6f %.6f %.6f %.6f %.6f\n", t, z[2], z[3], z[4], z[5], sqrt(P[2][2]));
    }
    dal_evaluator_free(evaluator);
    dal_run_free(run);
    dal_model_free(model);
    return 0;
}
