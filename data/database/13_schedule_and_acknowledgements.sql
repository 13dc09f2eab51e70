-- Layout 13: how many people are planned, who comes when, and which notes somebody has read.

-- How many complete sessions the study is to have. The last row counts.
CREATE TABLE planned_number (
  entry INTEGER PRIMARY KEY,
  num_participants INTEGER NOT NULL,
  time_ns INTEGER NOT NULL        -- when it was written down
);

-- Who comes when, by pseudonym. An appointment that is cancelled gets one more row, and the last
-- row of an appointment counts.
CREATE TABLE appointment (
  entry INTEGER PRIMARY KEY,
  appointment INTEGER NOT NULL,   -- from 1
  participant TEXT NOT NULL,
  starts_time_ns INTEGER NOT NULL,
  cancelled INTEGER NOT NULL,
  time_ns INTEGER NOT NULL        -- when it was written down
);

-- Somebody has read a note of a session, or an adverse event.
CREATE TABLE acknowledgement (
  entry INTEGER PRIMARY KEY,
  session INTEGER,                -- of the note, by the sequence of its event; or
  sequence INTEGER,
  adverse_event INTEGER REFERENCES adverse_event,
  time_ns INTEGER NOT NULL
);

CREATE TRIGGER planned_number_is_final BEFORE UPDATE ON planned_number
  BEGIN SELECT RAISE(ABORT, 'planned numbers are never changed'); END;
CREATE TRIGGER planned_number_stays BEFORE DELETE ON planned_number
  BEGIN SELECT RAISE(ABORT, 'planned numbers are never deleted'); END;
CREATE TRIGGER appointment_is_final BEFORE UPDATE ON appointment
  BEGIN SELECT RAISE(ABORT, 'appointments are never changed'); END;
CREATE TRIGGER appointment_stays BEFORE DELETE ON appointment
  BEGIN SELECT RAISE(ABORT, 'appointments are never deleted'); END;
CREATE TRIGGER acknowledgement_is_final BEFORE UPDATE ON acknowledgement
  BEGIN SELECT RAISE(ABORT, 'acknowledgements are never changed'); END;
CREATE TRIGGER acknowledgement_stays BEFORE DELETE ON acknowledgement
  BEGIN SELECT RAISE(ABORT, 'acknowledgements are never deleted'); END;
