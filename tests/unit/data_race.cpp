// SPDX-License-Identifier: Apache-2.0
// Negative control of the thread sanitizer. In this program, all threads of a loop write the same variable. The
// sanitizer must report this.
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
