#include "assets/recording/waves.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <mutex>
#include <numeric>

namespace flaneur {

namespace {

// Turns row and column p and q of a symmetric matrix so that its item (p, q) is 0 (Jacobi, 1846), and the
// rows of `turned` with them.
void turn(std::vector<double>& matrix, std::vector<double>& turned, int n, int p, int q) {
    const double off = matrix[p * n + q];
    if (off == 0) return;
    const double theta = (matrix[q * n + q] - matrix[p * n + p]) / (2 * off);
    const double t = (theta < 0 ? -1 : 1) / (std::fabs(theta) + std::sqrt(theta * theta + 1));
    const double c = 1 / std::sqrt(t * t + 1), s = t * c;
    for (int i = 0; i < n; ++i) {
        const double a = matrix[i * n + p], b = matrix[i * n + q];
        matrix[i * n + p] = c * a - s * b;
        matrix[i * n + q] = s * a + c * b;
    }
    for (int i = 0; i < n; ++i) {
        const double a = matrix[p * n + i], b = matrix[q * n + i];
        matrix[p * n + i] = c * a - s * b;
        matrix[q * n + i] = s * a + c * b;
        const double u = turned[p * n + i], v = turned[q * n + i];
        turned[p * n + i] = c * u - s * v;
        turned[q * n + i] = s * u + c * v;
    }
}

// Squared second differences, and a squared constant and line so that those two come first and alone.
std::vector<double> bending(int n) {
    std::vector<double> matrix(n * n, 0.0);
    for (int k = 0; k + 2 < n; ++k) {
        const double row[3] = {1, -2, 1};
        for (int i = 0; i < 3; ++i)
            for (int j = 0; j < 3; ++j) matrix[(k + i) * n + k + j] += row[i] * row[j];
    }
    double squares = 0;
    for (int i = 0; i < n; ++i) squares += (i - (n - 1) / 2.0) * (i - (n - 1) / 2.0);
    for (int i = 0; i < n; ++i)
        for (int j = 0; j < n; ++j) {
            matrix[i * n + j] -= 2.0 / n;
            if (n > 1) matrix[i * n + j] -= (i - (n - 1) / 2.0) * (j - (n - 1) / 2.0) / squares;
        }
    return matrix;
}

Waves make_waves(int n) {
    std::vector<double> matrix = bending(n), turned(n * n, 0.0);
    for (int i = 0; i < n; ++i) turned[i * n + i] = 1;
    for (int sweep = 0; sweep < 12; ++sweep)
        for (int p = 0; p + 1 < n; ++p)
            for (int q = p + 1; q < n; ++q) turn(matrix, turned, n, p, q);
    std::vector<int> order(n);
    std::iota(order.begin(), order.end(), 0);
    std::sort(order.begin(), order.end(),
              [&](int a, int b) { return matrix[a * n + a] < matrix[b * n + b]; });
    Waves waves{n, std::vector<float>(n * n)};
    for (int k = 0; k < n; ++k) {
        const double* row = &turned[order[k] * n];
        const double sign = row[0] < 0 ? -1 : 1;
        for (int i = 0; i < n; ++i) waves.values[k * n + i] = static_cast<float>(sign * row[i]);
    }
    return waves;
}

}  // namespace

const Waves& waves_of(int samples) {
    static std::array<Waves, k_most_samples + 1> all;
    static std::array<std::once_flag, k_most_samples + 1> made;
    std::call_once(made[samples], [samples] { all[samples] = make_waves(samples); });
    return all[samples];
}

}  // namespace flaneur
