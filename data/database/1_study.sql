-- Layout 1 of study.sqlite. Append only: a later event supersedes an earlier one, and triggers
-- refuse to change or delete a row. Column names are the words of the program and of the exports.
-- Files of this folder are carried out in the order of their numbers, each once, and never changed
-- after a release: what comes later is a file of its own.

CREATE TABLE study_format (version INTEGER NOT NULL, created_by TEXT NOT NULL);

CREATE TABLE protocol (
  sha256 TEXT PRIMARY KEY,
  file_name TEXT NOT NULL,
  text TEXT NOT NULL
);

CREATE TABLE session (
  session INTEGER PRIMARY KEY,
  participant TEXT NOT NULL,
  protocol_sha256 TEXT NOT NULL REFERENCES protocol,
  seed TEXT NOT NULL,             -- 64 bits without sign, so as text
  cells TEXT NOT NULL,
  pilot INTEGER NOT NULL,
  simulated INTEGER NOT NULL,
  device TEXT NOT NULL,
  laboratory TEXT NOT NULL,
  program_version TEXT NOT NULL,
  realtime TEXT NOT NULL,
  rate_hz REAL NOT NULL,
  recorded INTEGER NOT NULL,      -- samples are kept, not only summaries of strokes
  started_time_ns INTEGER NOT NULL
);

CREATE TABLE event (
  session INTEGER NOT NULL REFERENCES session,
  sequence INTEGER NOT NULL,
  kind TEXT NOT NULL,
  version INTEGER NOT NULL,
  time_ns INTEGER NOT NULL,
  stage INTEGER,
  trial INTEGER,
  attempt INTEGER,
  first_tick INTEGER,
  last_tick INTEGER,
  intensity REAL,
  supersedes INTEGER,
  data TEXT NOT NULL,
  PRIMARY KEY (session, sequence)
) WITHOUT ROWID;

CREATE TABLE design (
  session INTEGER NOT NULL REFERENCES session,
  trial INTEGER NOT NULL,
  stage INTEGER NOT NULL,
  block TEXT NOT NULL,
  procedure TEXT NOT NULL,
  medium TEXT NOT NULL,
  quantity TEXT NOT NULL,
  repetition INTEGER NOT NULL,
  position INTEGER NOT NULL,
  intensity REAL,
  reference_intensity REAL,
  starting_intensity REAL,
  target_percent REAL,
  PRIMARY KEY (session, trial)
) WITHOUT ROWID;

CREATE TABLE presentation (
  session INTEGER NOT NULL REFERENCES session,
  trial INTEGER NOT NULL,
  attempt INTEGER NOT NULL,
  presentation INTEGER NOT NULL,
  sequence INTEGER NOT NULL,
  interval TEXT NOT NULL,
  intensity REAL NOT NULL,
  first_tick INTEGER NOT NULL,
  last_tick INTEGER NOT NULL,
  stroke_width_m REAL,
  max_speed_m_per_s REAL,
  mean_height_m REAL,
  num_strokes INTEGER NOT NULL,
  delivered_damping_n_s_per_m REAL,
  commanded_damping_n_s_per_m REAL,
  limited_ticks INTEGER NOT NULL,
  PRIMARY KEY (session, trial, attempt, presentation)
) WITHOUT ROWID;

CREATE TABLE trial (
  session INTEGER NOT NULL REFERENCES session,
  trial INTEGER NOT NULL,
  attempt INTEGER NOT NULL,
  sequence INTEGER NOT NULL,
  block TEXT NOT NULL,
  procedure TEXT NOT NULL,
  medium TEXT NOT NULL,
  quantity TEXT NOT NULL,
  repetition INTEGER NOT NULL,
  position INTEGER NOT NULL,
  intensity REAL,
  reference_intensity REAL,
  starting_intensity REAL,
  target_percent REAL,
  response REAL,
  response_time_s REAL,
  num_presentations INTEGER NOT NULL,
  num_steps INTEGER NOT NULL,
  first_tick INTEGER NOT NULL,
  last_tick INTEGER NOT NULL,
  PRIMARY KEY (session, sequence)
) WITHOUT ROWID;

CREATE TABLE answer (
  session INTEGER NOT NULL REFERENCES session,
  sequence INTEGER NOT NULL,
  stage TEXT NOT NULL,
  item TEXT NOT NULL,
  answer TEXT NOT NULL,
  PRIMARY KEY (session, sequence, item)
) WITHOUT ROWID;

-- The sequences that a later event of the same session took back.
CREATE VIEW superseded AS
  SELECT session, supersedes AS sequence FROM event WHERE supersedes IS NOT NULL;

-- Trials set aside: the last word on them was `trial_excluded`, not `trial_included`.
CREATE VIEW excluded_trial AS
  SELECT session, trial FROM event AS last
  WHERE kind = 'trial_excluded'
    AND NOT EXISTS (SELECT 1 FROM event AS later
                    WHERE later.session = last.session AND later.trial = last.trial
                      AND later.kind IN ('trial_excluded', 'trial_included')
                      AND later.sequence > last.sequence);

-- Trials whose answer stands.
CREATE VIEW trial_in_force AS
  SELECT t.*, EXISTS (SELECT 1 FROM excluded_trial AS x
                      WHERE x.session = t.session AND x.trial = t.trial) AS excluded
  FROM trial AS t
  WHERE NOT EXISTS (SELECT 1 FROM superseded AS s
                    WHERE s.session = t.session AND s.sequence = t.sequence);

-- Presentations of the attempts whose answer stands.
CREATE VIEW presentation_in_force AS
  SELECT p.*, t.block, t.excluded FROM presentation AS p
  JOIN trial_in_force AS t
    ON t.session = p.session AND t.trial = p.trial AND t.attempt = p.attempt;

-- The last answer given to each item.
CREATE VIEW answer_in_force AS
  SELECT a.* FROM answer AS a
  WHERE NOT EXISTS (SELECT 1 FROM answer AS later
                    WHERE later.session = a.session AND later.stage = a.stage
                      AND later.item = a.item AND later.sequence > a.sequence)
    AND NOT EXISTS (SELECT 1 FROM superseded AS s
                    WHERE s.session = a.session AND s.sequence = a.sequence);

CREATE TRIGGER event_is_final BEFORE UPDATE ON event
  BEGIN SELECT RAISE(ABORT, 'events are never changed'); END;
CREATE TRIGGER event_stays BEFORE DELETE ON event
  BEGIN SELECT RAISE(ABORT, 'events are never deleted'); END;
CREATE TRIGGER trial_is_final BEFORE UPDATE ON trial
  BEGIN SELECT RAISE(ABORT, 'trials are never changed'); END;
CREATE TRIGGER trial_stays BEFORE DELETE ON trial
  BEGIN SELECT RAISE(ABORT, 'trials are never deleted'); END;
CREATE TRIGGER presentation_is_final BEFORE UPDATE ON presentation
  BEGIN SELECT RAISE(ABORT, 'presentations are never changed'); END;
CREATE TRIGGER presentation_stays BEFORE DELETE ON presentation
  BEGIN SELECT RAISE(ABORT, 'presentations are never deleted'); END;
