// SPDX-License-Identifier: Apache-2.0
// Negative control of the thread sanitizer: a loop whose threads write one variable. The test passes if this fails.
#include <cstdio>

int main()
{
    long sum = 0;
#pragma omp parallel for num_threads(4) schedule(static)
    for (int i = 0; i < 1000; ++i) {
        volatile long* shared = &sum;
        *shared = *shared + i;
    }
    std::printf("%ld\n", sum);
    return 0;
}
