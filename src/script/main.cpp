#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>
#include <iostream>

#include "core/error.hpp"
#include "core/lane.hpp"
#include "core/spelling.hpp"
#include "script/doctor.hpp"
#include "script/listings.hpp"
#include "script/option_checks.hpp"
#include "script/reference.hpp"
#include "script/render_command.hpp"
#include "script/repl.hpp"
#include "script/run_report.hpp"
#include "script/shard_choice.hpp"
#include "script/shard_end.hpp"
#include "script/shard_status.hpp"
#include "script/slurm.hpp"
#include "script/state.hpp"
#include "script/terminal.hpp"

namespace {
using namespace ricochet;

void refuse_odd_arguments(const std::vector<std::string>& arguments) {
  for (const std::string& argument : arguments)
    if (argument.starts_with('=') || argument.ends_with('='))
      throw Error(fmt::format("'{}': write name=value without spaces around '='", argument), Exit::usage);
  for (const std::string& argument : arguments)
    if (argument.find('=') == std::string::npos)
      throw Error(fmt::format("'{}' is neither an option nor name=value; see ricochet run --help", argument),
                  Exit::usage);
}

// The script, and then its study if one is asked for.
void run_in(State& state, Session& session) {
  const bool study = !session.options.study.empty();
  if (study) session.options.check = true;
  state.run_script();
  if (study && !session.done) {
    session.options.check = false;
    state.study_first_scene();
  }
  if (session.options.help && !session.done)
    session.print(fmt::format("{} declares no parameters.\n", session.script.string()));
}

void run(RunOptions options, const std::string& script, const std::vector<std::string>& arguments,
         const QueueOptions* queue = nullptr) {
  refuse_odd_arguments(arguments);
  if (options.out.empty()) throw Error("--out needs a folder", Exit::usage);
  if (options.part != Part::whole) {
    if (options.force || options.fresh || options.check || options.help)
      throw Error("--shard and merge go on with what is there: they take no --force, --new, --check or --help",
                  Exit::usage);
    options.resume = true;
  }
  if (options.force && (options.resume || options.fresh))
    throw Error("--resume continues earlier results, --force replaces them and --new leaves them; give one of them",
                Exit::usage);
  Session session(std::move(options), script, arguments);
  // With arguments, a misspelt one is reported first: ricochet.parameters then looks at the folder.
  if (!session.options.help && arguments.empty()) session.folders.refuse_earlier(session.own_folder());
  State state(session);  // until the report is there: replays of long sweeps are made by the script's functions
  try {
    run_in(state, session);
  } catch (const Error& error) {
    leave_shard_error(session, error);
    session.log(complaint(error.what()));
    const bool keep = error.exit == Exit::script && !stop_requested && session.folders.something_stored();
    try {
      session.write_log();
    } catch (const FileError&) {  // the first error is the one to report
    }
    if (keep)
      throw Error(fmt::format("{}\n  what was stored stays in {}; correct the script and add --resume", error.what(),
                              session.options.out));
    throw;
  }
  session.finish();
  if (queue) return submit_shards(session, *queue);
  if (session.options.part == Part::shard) return tell_nothing_left(session);
  write_report(session);
  if (session.nothing_finished())
    throw Error("not one impact finished; the first ended " + session.first_failure, Exit::numerical);
}

/// The commands of the program, and what the user gave.
struct Commands {
  CLI::App app{"A workbench for the impact of elastic bodies, driven by Lua scripts.", "ricochet"};
  CLI::App* run = nullptr;
  RunOptions options;
  RenderOptions drawing;
  ReportOptions report;
  QueueOptions queue;
  std::string script, file, theory, shard;
  std::vector<std::string> arguments;
  bool price = false, stubs = false, csv = false;
};

void add_script(Commands& c, CLI::App* command) {
  command->add_option("SCRIPT", c.script, "the Lua script; - reads it from standard input");
  command->add_option("name=value", c.arguments, "the script's parameters");
}

// What every command takes that runs impacts.
void add_running(Commands& c, CLI::App* command) {
  command->add_option("--threads", c.options.threads, "worker threads; all cores unless given")
      ->check(count_within(1, 1024));
  command->add_flag("--quiet", c.options.quiet, "print what the script prints, and warnings, alone");
  command->add_option("--out", c.options.out, fmt::format("folder of the results (default: {})", RunOptions{}.out));
}

void add_at_once(RunOptions& options, CLI::App* command) {
  const std::string text = fmt::format(
      "scenes of a sweep that are made and kept at once; more points go chunk by chunk, to the same results (default: "
      "{})",
      options.at_once);
  command->add_option("--at-once", options.at_once, text)->check(count_within(1, 10'000'000));
}

void add_run(Commands& c) {
  CLI::App* command = c.app.add_subcommand("run", "Run a script: ricochet run SCRIPT [name=value ...]");
  c.run = command;
  command->set_help_flag();  // --help after the script is the script's own
  add_script(c, command);
  RunOptions& options = c.options;
  command
      ->add_option("--batch", options.batch,
                   fmt::format("impacts that advance together, 1 to {}; never changes a result", lanes))
      ->check(count_within(1, lanes));
  add_running(c, command);
  command
      ->add_option("--max-seconds", options.max_seconds,
                   "end the run after so many seconds, impacts included; what is stored stays (default: no limit)")
      ->check(within(1e-3, 1e9));
  command->add_flag("--resume", options.resume, "go on with earlier results");
  command->add_flag("--force", options.force, "replace earlier results");
  command->add_flag("--new", options.fresh, "leave earlier results and go to a folder NAME-2, NAME-3 ...");
  command->add_flag("--check", options.check, "build every scene, run none");
  command
      ->add_option("--steps", options.steps,
                   "remember the methods and steps that trials chose in this file, rather than in run.steps of the "
                   "folder of results")
      ->type_name("FILE");
  command->add_option(
      "--shard", c.shard,
      "run only share K of N of the script's sweep, K from 0: K/N; auto takes it from the variables of "
      "a job of Slurm, MPI, PBS or Grid Engine (auto/N: N as given); ricochet merge makes results of all");
  command
      ->add_option("--flush", options.flush,
                   "of a shard or a long sweep: seconds of rows that a kill may lose (default: 30)")
      ->check(within(0, 86400));
  add_at_once(options, command);
  command->add_flag("!--no-report", options.report, "leave no report.html, and run no impact twice for its replays");
  command->add_flag("--traceback", options.traceback, "show where in the scripts an error came from");
  command->add_flag("--unsafe", options.unsafe, "lift the sandbox: io, os.execute, debug");
  command->add_flag("--help,-h", options.help, "this, or the script's own parameters");
  command->callback([&c] {
    if (!c.shard.empty()) choose_shard(c.options, c.shard);
    if (!c.script.empty()) return run(c.options, c.script, c.arguments);
    if (!c.options.help) throw Error("run needs a script: ricochet run SCRIPT [name=value ...]", Exit::usage);
    put(c.run->help("ricochet"));
  });
}

void add_merge(Commands& c) {
  CLI::App* command = c.app.add_subcommand(
      "merge", "Make results of the shards of a script's sweep: ricochet merge SCRIPT [name=value ...]");
  add_script(c, command);
  command->get_option("SCRIPT")->required();
  add_running(c, command);
  add_at_once(c.options, command);
  command->add_flag("--partial", c.options.partial, "of what is there, where impacts are missing");
  command->add_flag("!--no-report", c.options.report, "leave no report.html");
  command->add_flag("--unsafe", c.options.unsafe, "lift the sandbox, as run does");
  command->callback([&c] {
    c.options.part = Part::merge;
    run(c.options, c.script, c.arguments);
  });
}

void add_submit(Commands& c) {
  CLI::App* command = c.app.add_subcommand(
      "submit",
      "Submit the shards of a script's sweep that are not there, and their merging: ricochet submit SCRIPT "
      "[name=value ...] --slurm");
  QueueOptions& wanted = c.queue;
  add_script(c, command);
  command->get_option("SCRIPT")->required();
  command->add_flag("--slurm", wanted.slurm, "to Slurm, as an array of jobs");
  command->add_option("--shards", c.options.shards, "in so many; one a thousand impacts unless given or planned before")
      ->check(count_within(1, 10'000'000));
  command->add_option("--time", wanted.time,
                      "of a task, as sbatch takes it; near its end a task stores and goes on anew");
  command->add_option("--partition", wanted.partition, "of the cluster");
  command->add_option("--cpus", wanted.cpus, "threads of each task (default: 1)")->check(count_within(1, 1024));
  command->add_option("--max-running", wanted.running, "tasks at a time, at most")->check(count_within(0, 1'000'000));
  command
      ->add_option("--warning", wanted.warning,
                   "seconds before the end of its time in which a task stores what is done")
      ->check(count_within(1, 86400));
  command->add_option("--sbatch", wanted.sbatch, "a further option of sbatch for both jobs: --sbatch=--mem=2G")
      ->allow_extra_args(false);
  command->add_flag("--dry-run", wanted.dry_run, "write the plan and the scripts, submit nothing");
  add_running(c, command);
  command->add_option("--round", wanted.round)->group("");  // both by the merging job
  command->add_option("--of", wanted.of)->group("");
  command->callback([&c, &wanted] {
    if (c.script == standard_input)
      throw Error("jobs cannot read a script from standard input; give submit a file", Exit::usage);
    if (!wanted.slurm) throw Error("submit needs to know where to: --slurm", Exit::usage);
    c.options.part = Part::plan;
    run(c.options, c.script, c.arguments, &wanted);
  });
}

void add_status(Commands& c) {
  CLI::App* command = c.app.add_subcommand("status", "How far the sweeps of a folder are, shards or not");
  command->add_option("DIR", c.file, "a sweep's folder, or that of several")->required();
  command->add_flag("--csv", c.csv, "print the rows that are stored of one sweep, as comma-separated text");
  command->callback([&c] { c.csv ? print_stored(c.file) : print_status(c.file); });
}

void add_accuracy(Commands& c) {
  CLI::App* command = c.app.add_subcommand(
      "accuracy", "What accuracy costs in a script's first scene: ricochet accuracy SCRIPT [name=value ...]");
  add_script(c, command);
  command->get_option("SCRIPT")->required();
  add_running(c, command);
  command->add_flag("--force", c.options.force, "replace earlier results");
  command->add_flag("--new", c.options.fresh, "leave earlier results and go to a folder NAME-2, NAME-3 ...");
  command->callback([&c] {
    c.options.study = "require('ricochet').accuracy { scene = first_scene }";
    run(c.options, c.script, c.arguments);
  });
}

void price_effects(Commands& c) {
  c.options.study = "require('ricochet.effects').cost(first_scene, 5)";
  if (!c.script.empty()) return run(c.options, c.script, c.arguments);
  Session session(c.options, "effects", {});
  State(session).run_text("require('ricochet.effects').cost(nil, 5)");
}

void add_effects(Commands& c) {
  CLI::App* command = c.app.add_subcommand(
      "effects",
      "The effects that a scene may name, and what they cost: ricochet effects [--cost [SCRIPT [name=value ...]]]");
  command->add_flag("--cost", c.price, "measure what each costs, in the script's first scene or the paper's soft wall");
  add_script(c, command);
  add_running(c, command);
  command->callback([&c] {
    if (c.price) return price_effects(c);
    if (!c.script.empty())
      throw Error(
          fmt::format(
              "effects lists them all and takes no '{}'; to price those of a script: ricochet effects --cost SCRIPT",
              c.script),
          Exit::usage);
    print_effects();
  });
}

void add_theory(Commands& c) {
  CLI::App* command = c.app.add_subcommand("theory",
                                           "The theories that a script may call, with where they hold; ricochet theory "
                                           "errata: the paper's misprints and claims");
  command->add_option("NAME", c.theory,
                      "one of them; or errata: misprints, what is printed, what is right, how it was checked; claims, "
                      "what can be had by what");
  command->callback([&c] { c.theory == "errata" ? print_errata() : print_theories(c.theory); });
}

void add_repl_and_info(Commands& c) {
  c.app.add_subcommand("repl", "Type Lua")->callback(run_repl);
  c.app.add_subcommand("doctor", "What of the program works on this machine, what does not, and what to install")
      ->callback([] {
        if (!examine()) throw Error("the main job, an impact whose rows are stored, cannot be done here");
      });
  CLI::App* command = c.app.add_subcommand("info", "What a results.h5 holds and where it came from");
  command->add_option("FILE", c.file, "an HDF5 file of ours, or a folder with results")->required();
  command->callback([&c] { print_info(c.file); });
}

void add_render(Commands& c) {
  RenderOptions& drawing = c.drawing;
  CLI::App* command = c.app.add_subcommand(
      "render", "Draw a recorded impact: ricochet render FILE.h5 [name=value ...], with the names of the show table");
  command->add_option("FILE", drawing.file, "an HDF5 file of ricochet.record")->required();
  command->add_option("name=value", drawing.settings,
                      "what the pictures show: material=speed ledger=true ...; see show in ricochet reference");
  command->add_option("--size", drawing.size,
                      fmt::format("width and height in pixels (default: {})", RenderOptions{}.size));
  command->add_option("--out", drawing.out,
                      "folder of the frames (default: FILE_frames, unless only a film is asked for)");
  command->add_option("--film", drawing.film, "an .mp4 file; needs ffmpeg");
  command
      ->add_option("--rate", drawing.rate,
                   fmt::format("frames a second of the film (default: {})", RenderOptions{}.rate))
      ->check(within(1, 240));
  command->add_option("--threads", drawing.threads, "threads that encode; all cores unless given")
      ->check(count_within(1, 1024));
  command->add_flag("--resume", drawing.resume, "keep the frames that are drawn already");
  command->add_flag("--force", drawing.force, "replace what is there");
  command->add_flag("--quiet", drawing.quiet, "print nothing");
  command->callback([&drawing] { render_file(drawing); });
}

void add_report(Commands& c) {
  ReportOptions& wanted = c.report;
  CLI::App* command = c.app.add_subcommand(
      "report", "Make report.html, one file with plots and replays, of stored results: ricochet report DIR|results.h5");
  command->add_option("DIR", wanted.path, "a results.h5, or a folder with some in it or below")->required();
  command->add_option("--replays", wanted.replays, "at most so many, of those in an earlier report (default: 6)")
      ->check(count_within(0, 1000));
  command->add_option("--frames", wanted.frames, "at most so many moments of each replay (default: all that it has)")
      ->check(count_within(2, 2000));
  command->add_option("--title", wanted.title, "of the page (default: the first line of the script, if a comment)");
  command->add_option("--out", wanted.out, "the file (default: report.html in DIR)");
  command->callback([&wanted] { report_of_results(wanted); });
}

void add_reference(Commands& c) {
  CLI::App* command = c.app.add_subcommand("reference", "Print the reference of the Lua module");
  command->add_flag("--stubs", c.stubs, "as definitions for the Lua language server");
  command->callback([&c] { put(c.stubs ? editor_stubs() : reference_page()); });
}

// What the user may have meant by words that do not parse.
std::string hint_of(const Commands& c, const std::vector<std::string>& words) {
  std::vector<std::string> commands, options;
  for (const CLI::App* command : c.app.get_subcommands({})) commands.push_back(command->get_name());
  for (const CLI::Option* option : c.run->get_options())
    for (const std::string& name : option->get_lnames()) options.push_back("--" + name);
  std::string hint;
  for (const std::string& word : words) {
    if (!*c.run || !word.starts_with("--") || std::find(options.begin(), options.end(), word) != options.end())
      continue;
    hint = word.find('=') != std::string::npos
               ? fmt::format(" (a parameter of the script is written {}, without dashes)", word.substr(2))
               : did_you_mean(word, options);
  }
  if (words.empty()) return hint;
  if (words[0].ends_with(".lua")) return fmt::format(" (did you mean: ricochet run {}?)", words[0]);
  const bool known = std::find(commands.begin(), commands.end(), words[0]) != commands.end();
  return known ? hint : did_you_mean(words[0], commands);
}

void program(int count, char** words) {
  Commands c;
  c.app.require_subcommand(1);
  c.app.set_version_flag("--version", version_text);
  for (const auto add : {add_run, add_merge, add_submit, add_status, add_accuracy, add_effects, add_theory,
                         add_repl_and_info, add_render, add_report, add_reference})
    add(c);
  try {
    c.app.parse(count, words);
  } catch (const CLI::CallForHelp&) {
    put(c.app.help());
  } catch (const CLI::CallForVersion&) {
    put(version_text() + "\n");
  } catch (const CLI::ParseError& error) {
    const std::string hint = hint_of(c, {words + std::min(count, 1), words + count});
    throw Error(fmt::format("{}{}; see ricochet --help", error.what(), hint), Exit::usage);
  }
}

// The program's exit status.
Exit answer(int count, char** words) {
  try {
    program(count, words);
    return Exit::ok;
  } catch (const Error& error) {
    say(complaint(error.what()));
    return error.exit;
  } catch (const std::filesystem::filesystem_error& error) {
    say(complaint(as_error(error).what()));
    return Exit::file;
  } catch (const std::exception& error) {
    say(complaint(fmt::format("{} (this is a mistake of the program; please report it)", error.what())));
    return Exit::script;
  }
}

}  // namespace

int main(int count, char** words) {
  open_standard_descriptors();
  catch_signals();
  const Exit status = answer(count, words);
  const std::string lost = output_lost();
  if (status != Exit::ok || lost.empty()) return static_cast<int>(status);
  say(complaint(fmt::format(
      "some of the output was lost: standard output cannot be written ({}); what the run stored is whole", lost)));
  return static_cast<int>(Exit::file);
}
