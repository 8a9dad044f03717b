#include "tools/flaneur/recording/program.h"

namespace flaneur {

std::string this_program() {
    const std::string commit = FLANEUR_COMMIT;
    return FLANEUR_VERSION " (" + commit.substr(0, 8) + ")";
}

}  // namespace flaneur
