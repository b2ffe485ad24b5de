#include "tools/faults/write_order.h"

#include "base/files.h"
#include "tools/faults/failing_calls.h"

#include <algorithm>
#include <array>
#include <fmt/format.h>
#include <map>
#include <set>

namespace shadowbench::faults {
namespace fs = std::filesystem;
namespace {

/// What the verb that made it makes again of records (base/files.h, writeFileUnflushed).
bool isMadeAgain(const fs::path& file) {
    constexpr std::array kinds{".html", ".css", ".js", ".csv", ".tex", ".md", ".svg", ".pdf", ".png"};
    return std::ranges::find(kinds, file.extension()) != kinds.end();
}

class Order {
public:
    explicit Order(fs::path folder) : folder_(std::move(folder)) {}

    void see(const Call& call) {
        if (!call.path.starts_with(folder_.string()) || !isOwn(call)) return;
        const std::string below = call.path.substr(folder_.string().size());
        if (below.starts_with("/tmp/")) return;
        if (call.kind == Kind::Open && call.creates) {
            unflushed_.insert(call.path);
            if (!isTemporary(call.path)) order_.faults.push_back(below + " is written in place");
        }
        if (call.kind == Kind::Write) unflushed_.insert(call.path);
        if (call.kind == Kind::Fsync) {
            unflushed_.erase(call.path);
            std::erase_if(named_, [&](const fs::path& file) { return file.parent_path() == call.path; });
        }
        if (call.kind == Kind::Rename) rename(call, below);
    }

    WriteOrder result() {
        for (const fs::path& file : named_)
            order_.faults.push_back(file.lexically_relative(folder_).string() +
                                    ": its folder is not flushed after its rename");
        return std::move(order_);
    }

private:
    void rename(const Call& call, const std::string& below) {
        if (isMadeAgain(call.path) && unflushed_.contains(call.from)) {
            ++order_.madeAgain;
            return;
        }
        ++order_.renames;
        if (unflushed_.contains(call.from)) order_.faults.push_back(below + " is renamed before it is flushed");
        named_.insert(call.path);
    }

    fs::path folder_;
    WriteOrder order_;
    std::set<std::string> unflushed_;
    std::set<fs::path> named_; // whose folders are not flushed yet
};

} // namespace

WriteOrder writeOrderOf(Sandbox& sandbox, const Verb& verb) {
    sandbox.reset();
    Order order(sandbox.folder());
    (void)sandbox.run(verb, [&](const Call& call, pid_t) {
        order.see(call);
        return Decision{};
    });
    return order.result();
}

std::string orderReport(const std::vector<std::pair<std::string, WriteOrder>>& verbs, const std::string& command) {
    std::string text = fmt::format(
        "# What a power cut would leave\n\n`{}`\n\nOf the system calls of each verb: every file gets its name by a rename, "
        "is "
        "flushed before it, and its folder after it. Pages, tables and charts, which the same command makes again of the "
        "records, need not be flushed.\n\n| verb | flushed, renamed, folder flushed | made again | faults "
        "|\n|---|--:|--:|--:|\n",
        command);
    std::string faults;
    for (const auto& [verb, order] : verbs) {
        text += fmt::format("| {} | {} | {} | {} |\n", verb, order.renames, order.madeAgain, order.faults.size());
        for (const std::string& fault : order.faults) faults += fmt::format("* {}: {}\n", verb, fault);
    }
    return text + "\n## Faults\n\n" + (faults.empty() ? "None.\n" : faults);
}

} // namespace shadowbench::faults
