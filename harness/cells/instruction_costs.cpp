#include "harness/cells/instruction_costs.h"

#include "base/parallel.h"
#include "base/progress_line.h"
#include "harness/measure/callgrind.h"

#include <filesystem>
#include <mutex>

namespace shadowbench {
namespace {

/// Cells a process: enough to share its start (some seconds under Valgrind), few enough to lose little when it is killed.
constexpr std::size_t cellsPerJob = 6;

struct Job {
    timing::CountJob work;
    std::vector<Record*> records; // one a variant
};

std::string reachable(const std::string& scene) {
    return scene.find('/') == std::string::npos && !std::filesystem::exists(scene)
               ? scene
               : std::filesystem::absolute(scene).string();
}

std::vector<Job> jobsFor(std::vector<Record>& records, const InstructionOptions& options) {
    std::vector<Job> jobs;
    for (Record& record : records) {
        if (!wasScored(record.status) || record.values["cost.instructions"] || isExternal(record)) continue;
        if (jobs.empty() || jobs.back().records.front()->scene != record.scene || jobs.back().records.size() == cellsPerJob)
            jobs.push_back({{reachable(options.scenes.at(record.scene)), {}, options.profile, record.seed}, {}});
        jobs.back().work.variants.push_back(record.variant);
        jobs.back().records.push_back(&record);
    }
    return jobs;
}

class Pool {
public:
    Pool(std::vector<Job> jobs, bool quiet, const std::function<void()>& onCounted)
        : jobs_(std::move(jobs)), line_("instructions", total(jobs_), quiet), onCounted_(onCounted),
          version_(timing::valgrindVersion()) {}

    void runAll() {
        inParallel(static_cast<int>(jobs_.size()), availableThreads(),
                   [this](int i) { fillIn(jobs_[static_cast<std::size_t>(i)]); });
    }

private:
    static int total(const std::vector<Job>& jobs) {
        std::size_t cells = 0;
        for (const Job& job : jobs) cells += job.records.size();
        return static_cast<int>(cells);
    }

    void fillIn(const Job& job) {
        const timing::Counts counts = timing::countInstructions(job.work, [&](std::string_view variant) {
            const std::scoped_lock lock(mutex_);
            line_.show(++done_, 0, variant);
        });
        const std::scoped_lock lock(mutex_);
        for (Record* record : job.records) {
            const auto found = counts.find(record->variant);
            if (found == counts.end()) {
                record->status = Status::Error;
                record->reason = "its frame could not be rendered under Valgrind";
                continue;
            }
            record->values["cost.instructions"] = static_cast<double>(found->second);
            record->environment.valgrind = version_;
        }
        onCounted_();
    }

    std::vector<Job> jobs_;
    ProgressLine line_;
    const std::function<void()>& onCounted_;
    std::string version_;
    std::mutex mutex_;
    int done_ = 0;
};

} // namespace

void countInstructions(std::vector<Record>& records, const InstructionOptions& options,
                       const std::function<void()>& onCounted) {
    std::vector<Job> jobs = jobsFor(records, options);
    if (!jobs.empty()) Pool(std::move(jobs), options.quiet, onCounted).runAll();
}

} // namespace shadowbench
