// SPDX-License-Identifier: Apache-2.0
#include "../../../tools/srisptool/job.h"

#include <doctest/doctest.h>

#include "../failure_of.h"
#include "scratch_folder.h"

using namespace srisp;
using namespace srisp::tool;

namespace {

nlohmann::json job(const std::vector<std::string>& words)
{
    return job_of(parse_command_line(words).front());
}

std::string failure(const std::vector<std::string>& words)
{
    return failure_of([&] { job(words); });
}

} // namespace

TEST_CASE("a job holds what the command says, paths absolute")
{
    const ScratchFolder scratch;
    const std::string reference = scratch.file("r #1.dng"), parameters = scratch.file("p:q.json");
    const std::filesystem::path before = std::filesystem::current_path();
    std::filesystem::current_path(scratch.path());
    const nlohmann::json found =
        job({ "--srisp-unprocess:params=\"p:q.json\":model=spatial:input=linear:precision=fast:seed=7:hold=1",
              "r #1.dng" });
    std::filesystem::current_path(before);
    CHECK(found == nlohmann::json{ { "format", "srisp-recipe-1" },
                                   { "direction", "reverse" },
                                   { "reference", reference },
                                   { "parameters", parameters },
                                   { "model", "spatial" },
                                   { "input", "linear" },
                                   { "precision", "fast" },
                                   { "seed", 7 },
                                   { "hold", true } });
    CHECK(job({ "--srisp-process" }) == nlohmann::json{ { "format", "srisp-recipe-1" }, { "direction", "forward" } });
    CHECK(job({ "--srisp-unprocess:params='" + parameters + "'", "-" }).contains("reference") == false);
}

TEST_CASE("lists and globs become arrays, and a name that exists is itself, also beside others")
{
    const ScratchFolder scratch;
    const std::string a = scratch.file("a.dng"), b = scratch.file("b.dng"), both = scratch.file("a.dng;b*.dng"),
                      odd = scratch.file("y[1].dng"), glob = scratch.path("?.dng");
    CHECK(job({ "--srisp-params", a + ";" + b })["reference"] == nlohmann::json{ a, b });
    CHECK(job({ "--srisp-params", glob })["reference"] == nlohmann::json{ glob });
    CHECK(job({ "--srisp-params", both })["reference"] == both);
    CHECK(job({ "--srisp-params", a + ";" + both + ";" + odd + ";" + glob })["reference"] ==
          nlohmann::json{ a, both, odd, glob });
    CHECK(job({ "--srisp-params", scratch.path() })["reference"] == scratch.path());
}

TEST_CASE("what is missing is said with its name, before anything runs")
{
    const ScratchFolder scratch;
    const std::string reference = scratch.file("r.dng");
    CHECK(failure({ "--srisp-unprocess", "no.dng" }) == "1: --srisp-unprocess: reference 'no.dng' does not exist");
    CHECK(failure({ "--srisp-unprocess", reference + ";no.dng" }) ==
          "1: --srisp-unprocess: reference 'no.dng' does not exist");
    CHECK(failure({ "--srisp-unprocess", "no*.dng" }) == "1: --srisp-unprocess: reference 'no*.dng' does not exist");
    CHECK(failure({ "--srisp-unprocess", ";" }) == "2: --srisp-unprocess: the list of references ';' is empty");
    CHECK(failure({ "--srisp-unprocess:params=no.json", reference }) ==
          "1: --srisp-unprocess: parameter file 'no.json' does not exist");
    CHECK(failure({ "--srisp-process:params=" + scratch.path() }) ==
          "1: --srisp-process: parameter file '" + scratch.path() + "' is a folder, not a file");
    CHECK(failure({ "--srisp-process:model=a/no.safetensors" }) ==
          "1: --srisp-process: model 'a/no.safetensors' does not exist");
    CHECK(failure({ "--srisp-process:model=spatail" })
              .rfind("2: --srisp-process: unknown model 'spatail'; did you mean 'spatial'?", 0) == 0);
    CHECK(failure({ "--srisp-save-params", "/no/such/p.json" }) ==
          "1: --srisp-save-params: the folder of '/no/such/p.json' does not exist");
    CHECK(failure({ "--srisp-save-params", scratch.path() }) ==
          "1: --srisp-save-params: '" + scratch.path() + "' is a folder, not a file");
}

TEST_CASE("wrong modifiers are wrong usage")
{
    CHECK(failure({ "--srisp-unprocess:modl=a", "-" }) ==
          "2: '--srisp-unprocess:modl=a': unknown modifier 'modl'; did you mean 'model'?");
    CHECK(failure({ "--srisp-process:hold=1" }) ==
          "2: '--srisp-process:hold=1': unknown modifier 'hold'; known: model, params, precision");
    CHECK(failure({ "--srisp-unprocess:input=raw", "-" }) ==
          "2: --srisp-unprocess: unknown input 'raw'; known: auto, srgb, linear");
    CHECK(failure({ "--srisp-unprocess:hold=yes", "-" }) == "2: --srisp-unprocess: hold 'yes' is neither 0 nor 1");
    CHECK(failure({ "--srisp-unprocess:seed=-1", "-" }) ==
          "2: --srisp-unprocess: seed '-1' is not a whole number from 0 to 18446744073709551615");
    CHECK(failure({ "--srisp-unprocess", "-" }) == "2: --srisp-unprocess -: without a reference it needs params=FILE");
}
