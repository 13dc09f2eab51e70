-- Layout 10: looks at a sequential study before all have taken part.

-- What the rule of the study file came to at each look, kept before anybody is told.
CREATE TABLE sequential_look (
  look INTEGER PRIMARY KEY,       -- from 1
  decision TEXT NOT NULL,         -- go_on, stop
  time_ns INTEGER NOT NULL,
  program_version TEXT NOT NULL
);

-- The sessions that it rests on; those that came to it since the look before.
CREATE TABLE sequential_look_session (
  look INTEGER NOT NULL REFERENCES sequential_look,
  session INTEGER NOT NULL,
  PRIMARY KEY (look, session)
) WITHOUT ROWID;

-- Somebody opened the results before the rule had ended the study.
CREATE TABLE unsealing (
  time_ns INTEGER NOT NULL,
  num_complete INTEGER NOT NULL,  -- sessions, by then
  reason TEXT NOT NULL
);

CREATE TRIGGER sequential_look_is_final BEFORE UPDATE ON sequential_look
  BEGIN SELECT RAISE(ABORT, 'looks are never changed'); END;
CREATE TRIGGER sequential_look_stays BEFORE DELETE ON sequential_look
  BEGIN SELECT RAISE(ABORT, 'looks are never deleted'); END;
CREATE TRIGGER sequential_look_session_is_final BEFORE UPDATE ON sequential_look_session
  BEGIN SELECT RAISE(ABORT, 'looks are never changed'); END;
CREATE TRIGGER sequential_look_session_stays BEFORE DELETE ON sequential_look_session
  BEGIN SELECT RAISE(ABORT, 'looks are never deleted'); END;
CREATE TRIGGER unsealing_is_final BEFORE UPDATE ON unsealing
  BEGIN SELECT RAISE(ABORT, 'unsealings are never changed'); END;
CREATE TRIGGER unsealing_stays BEFORE DELETE ON unsealing
  BEGIN SELECT RAISE(ABORT, 'unsealings are never deleted'); END;
