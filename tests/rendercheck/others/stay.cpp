// Where vkcube takes its window away, waits, so that its last picture can be taken: loaded into it by
// LD_PRELOAD.
#include <unistd.h>

#include <cstdio>
#include <cstdlib>

extern "C" int xcb_destroy_window(void*, unsigned) {
    if (const char* file = std::getenv("STAYS"))
        if (std::FILE* made = std::fopen(file, "w")) std::fclose(made);
    for (;;) pause();
}
