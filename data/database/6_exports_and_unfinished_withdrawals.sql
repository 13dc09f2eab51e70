-- Layout 6: where the study was exported to, how far a withdrawal has come, and adverse events.

-- Folders that an export or a report was written to: what a withdrawal cannot reach, but names.
-- The last row of a place counts, for nothing is written to a place that holds anything.
CREATE TABLE export (
  export INTEGER PRIMARY KEY,
  place TEXT NOT NULL,            -- absolute
  kind TEXT NOT NULL,             -- csv, bids, hdf5, report
  time_ns INTEGER NOT NULL
);

-- The sessions that were in it.
CREATE TABLE export_session (
  export INTEGER NOT NULL REFERENCES export,
  session INTEGER NOT NULL,
  PRIMARY KEY (export, session)
) WITHOUT ROWID;

-- Steps of withdrawals; the last row of a participant counts. Those of layouts before have none.
CREATE TABLE withdrawal_step (
  step INTEGER PRIMARY KEY,
  participant TEXT NOT NULL,
  state TEXT NOT NULL,            -- begun, erased (in this folder), finished (in its backups, too)
  time_ns INTEGER NOT NULL
);

-- What happened to a participant that must not happen. Kept for good, also after a withdrawal.
CREATE TABLE adverse_event (
  adverse_event INTEGER PRIMARY KEY,
  session INTEGER NOT NULL,
  participant TEXT NOT NULL,
  time_ns INTEGER NOT NULL,
  text TEXT NOT NULL
);

CREATE TRIGGER export_is_final BEFORE UPDATE ON export
  BEGIN SELECT RAISE(ABORT, 'exports are never changed'); END;
CREATE TRIGGER export_stays BEFORE DELETE ON export
  BEGIN SELECT RAISE(ABORT, 'exports are never deleted'); END;
CREATE TRIGGER export_session_is_final BEFORE UPDATE ON export_session
  BEGIN SELECT RAISE(ABORT, 'exports are never changed'); END;
CREATE TRIGGER export_session_stays BEFORE DELETE ON export_session
  BEGIN SELECT RAISE(ABORT, 'exports are never deleted'); END;
CREATE TRIGGER withdrawal_step_is_final BEFORE UPDATE ON withdrawal_step
  BEGIN SELECT RAISE(ABORT, 'withdrawals are never changed'); END;
CREATE TRIGGER withdrawal_step_stays BEFORE DELETE ON withdrawal_step
  BEGIN SELECT RAISE(ABORT, 'withdrawals are never deleted'); END;
CREATE TRIGGER adverse_event_is_final BEFORE UPDATE ON adverse_event
  BEGIN SELECT RAISE(ABORT, 'adverse events are never changed'); END;
CREATE TRIGGER adverse_event_stays BEFORE DELETE ON adverse_event
  BEGIN SELECT RAISE(ABORT, 'adverse events are never deleted'); END;
