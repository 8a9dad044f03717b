#include "tools/flaneur/options/commands.h"
#include "tools/flaneur/options/refusal.h"

namespace flaneur {
namespace {

constexpr const char* k_validate_footer =
    R"(Runs without Vulkan. Each test sets people down on floors made for it, and holds what they do against what is expected: RiMEA's
R1 to R16, NIST's N2.8 and N2.9, Weidmann's diagram. Prints set-up, expected and measured, and ends with 0 only if all
is as expected. docs/validation.md tells how each is measured.
--measured takes trajectories of people, as docs/trajectories.md says which: the chart shows them beside ours, and whoever
was measured in a corridor walks it again (BI), entering when and where they did.
Examples:
  flaneur validate                                         all, some three minutes
  flaneur validate R4 N2.8                                 these
  flaneur validate --list                                  what there is
  flaneur validate --json out/v.json --svg out/diagram.svg --measured corridor.txt --measured neck.h5
  flaneur validate BI --measured corridor.txt)";

}  // namespace

void add_validate(CLI::App& app, Options& options) {
    ValidateOptions& validation = options.validation;
    CLI::App* command = app.add_subcommand("validate", "Hold the crowd against what is known of people's")
                            ->footer(k_validate_footer);
    command->callback([&] { options.command = Command::validate; });
    command->add_option("tests", validation.tests, "Those alone, by their names")
        ->type_name("TEST")
        ->take_all();
    command
        ->add_option(
            "--measured", validation.measured,
            "Trajectories of people, of any format that docs/trajectories.md has; may be given several times")
        ->type_name("FILE")
        ->allow_extra_args(false)
        ->take_all();
    command->add_option("--json", options.json, "Write it to a file too")->type_name("FILE");
    command->add_option("--markdown", validation.markdown, "Write it as a table of Markdown")
        ->type_name("FILE");
    command
        ->add_option("--svg", validation.svg, "Draw speed over density: ours, Weidmann's, what was measured")
        ->type_name("FILE");
    command->add_flag("--list", validation.list, "Say which tests there are");
}

}  // namespace flaneur
