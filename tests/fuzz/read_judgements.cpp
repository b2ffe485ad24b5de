#include "gate/gate_config.h"
#include "gate/policy.h"
#include "studies/behaviour/behaviour.h"
#include "studies/claims/claims.h"
#include "studies/papers/papers.h"
#include "tests/fuzz/readers.h"
#include "tests/fuzz/target.h"

namespace shadowbench::fuzz {

void readBounds(std::string_view input) {
    const gate::GateConfig list = gate::parseGateConfig(std::string(input), "bounds.toml", Profile::Gate);
    (void)list.unknownScenes({});
    (void)list.isByChance("simple", "sm-uniform");
    for (const gate::BoundRule& bound : list.bounds) (void)bound.cells.named();
}

void readPolicyOfAProgram(std::string_view input) {
    const gate::BuildInfo identity = gate::buildInfoFrom(std::string(input));
    const std::string written = gate::toJson(identity);
    require(gate::toJson(gate::buildInfoFrom(written)) == written, "a policy is another one after it was written and read");
    require(gate::loosened(identity.policy, identity.policy).empty(), "a policy is looser than itself");
}

void readClaimList(std::string_view input) {
    const std::vector<Claim> claims = parseClaims(input);
    std::vector<Judgement> judgements;
    for (const Claim& claim : claims) judgements.push_back(judge(claim, {}));
    claimsReport(judgements, "json");
}

void readBehaviourList(std::string_view input) { behaviourTable(parseBehaviours(input), {}, Markup::Latex); }

void readPaperPages(std::string_view input) {
    for (const PaperPage& page : parsePaperPages(input)) paperPage(page, {}, std::vector<std::string>(page.charts.size()));
}

} // namespace shadowbench::fuzz
