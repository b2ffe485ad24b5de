#include "base/error.h"
#include "base/files.h"
#include "base/hash.h"
#include "groundtruth/contract/reference_files.h"
#include "harness/cells/golden_lock.h"
#include "tests/fuzz/readers.h"
#include "tests/fuzz/target.h"

namespace shadowbench::fuzz {

void readCacheEntry(std::string_view input) {
    std::string bytes(input);
    const std::uint64_t sum = hash64(bytes);
    bytes.append(reinterpret_cast<const char*>(&sum), sizeof sum);
    const groundtruth::Reference reference = groundtruth::decode(bytes, groundtruth::decodeHeader(bytes).key);
    const std::string written = groundtruth::encode(reference);
    const groundtruth::Reference again = groundtruth::decode(written, groundtruth::decodeHeader(bytes).key);
    require(groundtruth::encode(again) == written, "a reference is another one after it was written and read");
}

void readGoldenLock(std::string_view input) {
    const auto rewritten = [](const GoldenLock& lock) {
        writeLock(lock, folder());
        return readFile(lockFile(folder()));
    };
    const std::string written = rewritten(parseLock(std::string(input), "lock.json"));
    require(rewritten(readLock(folder())) == written, "a lock is another one after it was written and read");
}

} // namespace shadowbench::fuzz
