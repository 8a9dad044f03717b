#include <cstdio>

#include "assets/files/file.h"
#include "tools/flaneur/city/check.h"
#include "tools/flaneur/city/model.h"
#include "tools/flaneur/commands.h"
#include "tools/flaneur/console/console.h"
#include "tools/flaneur/load/load.h"
#include "tools/flaneur/output/output.h"

namespace flaneur {

Result<void> run_city(const Options& options) {
    if (options.check) return check_city(options);
    if (!has_ending(options.out, ".glb") && !is_stream(options.out))
        return Error{"city --out " + options.out + " is no .glb, which is what a city is written as."};
    Result<PartFilePtr> file = open_file(options.out);
    if (!file) return file.error();
    Result<City> city = read_city(options.scene);
    if (!city) return city.error();
    clear_progress();
    return write_file(std::move(*file), still_glb(city_model(*city)));
}

}  // namespace flaneur
