#pragma once

namespace ricochet {

/// Runs what the user types until the end of input. Values keep from one entry to the next, `local` ones too; an entry
/// that is not complete goes on in the next line. On a terminal lines are edited, completed and remembered (readline).
void run_repl();

}  // namespace ricochet
