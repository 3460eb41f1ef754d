// SPDX-License-Identifier: MIT
#include "sbatch.hpp"

#include <filesystem>

#include "terminal.hpp"

namespace banyan::cli {
namespace {

// As one word of a shell.
std::string quoted(const std::string& text) {
  std::string word = "'";
  for (const char c : text) word += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return word + "'";
}

}  // namespace

std::string sbatch_script(const StudyOptions& options, const std::string& name, const std::string& folder) {
  namespace fs = std::filesystem;
  const std::string program = quoted(fs::read_symlink("/proc/self/exe").string());
  const std::string file = quoted(fs::absolute(options.file).lexically_normal().string());
  const std::string shards = std::to_string(options.shards);
  std::string changes;
  for (const auto& o : options.overrides)
    changes += o.file.empty() ? " --set " + quoted(o.assignment) : " --with " + quoted(fs::absolute(o.file).string());
  const bool plain = options.sbatch.find_first_of("\n'\"$`\\ ") == std::string::npos;
  const std::string script = options.sbatch == "-" || !plain ? "THIS-FILE" : options.sbatch;
  // The user has confirmed already when writing the script.
  const std::string more =
      std::string(options.extend ? " --extend" : "") + (options.mix_versions ? " --mix-versions" : "");
  return "#!/bin/bash\n"
         "# The study " +
         name +
         " as a job array, a shard per task, and then its tables. Adapt time and memory:\n"
         "#   job=$(sbatch --parsable " +
         script +
         ")\n"
         "#   sbatch --dependency=afterany:$job --wrap \"$(tail -n 1 " +
         script + ")\"\n" +
         "# A task that was cut off resumes where it stopped when the array is submitted again.\n"
         "#SBATCH --job-name=banyan-" +
         name +
         "\n"
         "#SBATCH --array=1-" +
         shards +
         "\n"
         "#SBATCH --ntasks=1\n"
         "#SBATCH --cpus-per-task=" +
         std::to_string(std::max(1, options.threads)) +
         "\n"
         "#SBATCH --mem-per-cpu=500M\n"
         "#SBATCH --time=04:00:00\n"
         "\n"
         "mkdir -p " +
         quoted(folder) +
         "\n"
         "exec " +
         program + " study " + file + " --out " + quoted(folder) + changes + " \\\n  --shard \"$SLURM_ARRAY_TASK_ID/" +
         shards + "\" --threads \"${SLURM_CPUS_PER_TASK:-1}\" --quiet --yes" + more +
         (options.retry ? " --retry" : "") +
         "\n"
         "\n"
         "# When all tasks are done (after exec, so never by a task):\n" +
         program + " collect " + file + " --out " + quoted(folder) + changes + " --yes" + more + "\n";
}

}  // namespace banyan::cli
