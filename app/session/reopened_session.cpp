#include "app/session/reopened_session.h"

#include "app/session/stored_session.h"

namespace jnd::app {

ReopenedSession::ReopenedSession(core::StudyStore& store, const core::SessionRow& row)
    : store_(store),
      study_(stored_study(store, row.session)),
      session_({.session = row.session,
                .seed = row.seed,
                .stages = stages_of_session(study_, row.cells),
                .cell = experiments::cell_from_text(study_, row.cells)},
               store.events(row.session), *this, clock_) {}

}  // namespace jnd::app
