-- Layout 2: whose study it is, where its file lies, what was copied and who withdrew.

-- Tells a backup of this study from the folder of another one.
CREATE TABLE study_identity (study_id TEXT NOT NULL);
INSERT INTO study_identity VALUES (lower(hex(randomblob(16))));

-- Where the study file was read from, seen from the study folder; '' where nobody knows. Another
-- text in it later is told when a session is resumed.
ALTER TABLE protocol ADD COLUMN relative_path TEXT NOT NULL DEFAULT '';

-- Folders that hold a copy, so that a withdrawal reaches them. The last row of a folder counts.
CREATE TABLE backup (
  backup INTEGER PRIMARY KEY,
  folder TEXT NOT NULL,
  time_ns INTEGER NOT NULL,
  forgotten INTEGER NOT NULL      -- Said to exist no more.
);

-- When a double-blind study was opened to the eye; its sessions have an event of it besides.
CREATE TABLE unblinding (time_ns INTEGER NOT NULL, reason TEXT NOT NULL);

-- The tombstone of a participant who withdrew: that there was a session, and nothing else of it.
CREATE TABLE withdrawal (
  session INTEGER PRIMARY KEY,
  participant TEXT NOT NULL,
  time_ns INTEGER NOT NULL,
  num_events INTEGER NOT NULL,
  num_trials INTEGER NOT NULL
);

-- What the views of layout 1 ask of every trial.
CREATE INDEX event_of_trial ON event (session, kind, trial);
CREATE INDEX event_superseding ON event (session, supersedes) WHERE supersedes IS NOT NULL;
CREATE INDEX event_unblinded ON event (kind) WHERE kind = 'unblinded';

CREATE TRIGGER protocol_is_final BEFORE UPDATE ON protocol
  BEGIN SELECT RAISE(ABORT, 'protocols are never changed'); END;
CREATE TRIGGER protocol_stays BEFORE DELETE ON protocol
  BEGIN SELECT RAISE(ABORT, 'protocols are never deleted'); END;
CREATE TRIGGER session_is_final BEFORE UPDATE ON session
  BEGIN SELECT RAISE(ABORT, 'sessions are never changed'); END;
CREATE TRIGGER session_stays BEFORE DELETE ON session
  BEGIN SELECT RAISE(ABORT, 'sessions are never deleted'); END;
CREATE TRIGGER design_is_final BEFORE UPDATE ON design
  BEGIN SELECT RAISE(ABORT, 'the design is never changed'); END;
CREATE TRIGGER design_stays BEFORE DELETE ON design
  BEGIN SELECT RAISE(ABORT, 'the design is never deleted'); END;
CREATE TRIGGER answer_is_final BEFORE UPDATE ON answer
  BEGIN SELECT RAISE(ABORT, 'answers are never changed'); END;
CREATE TRIGGER answer_stays BEFORE DELETE ON answer
  BEGIN SELECT RAISE(ABORT, 'answers are never deleted'); END;
CREATE TRIGGER withdrawal_is_final BEFORE UPDATE ON withdrawal
  BEGIN SELECT RAISE(ABORT, 'withdrawals are never changed'); END;
CREATE TRIGGER withdrawal_stays BEFORE DELETE ON withdrawal
  BEGIN SELECT RAISE(ABORT, 'withdrawals are never deleted'); END;
