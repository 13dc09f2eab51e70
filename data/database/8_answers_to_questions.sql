-- Layout 8: questions that follow the answer to every trial of a block.

-- What was answered to each, as it was given; "no_answer" where it was left out.
CREATE TABLE question_answer (
  session INTEGER NOT NULL REFERENCES session,
  trial INTEGER NOT NULL,
  attempt INTEGER NOT NULL,
  sequence INTEGER NOT NULL,
  block TEXT NOT NULL,
  question TEXT NOT NULL,
  answer TEXT NOT NULL,
  PRIMARY KEY (session, sequence)
) WITHOUT ROWID;

-- Those of the attempts whose answer stands: who takes that back takes these with it.
CREATE VIEW question_answer_in_force AS
  SELECT q.*, t.excluded FROM question_answer AS q
  JOIN trial_in_force AS t
    ON t.session = q.session AND t.trial = q.trial AND t.attempt = q.attempt;

CREATE TRIGGER question_answer_is_final BEFORE UPDATE ON question_answer
  BEGIN SELECT RAISE(ABORT, 'answers to questions are never changed'); END;
CREATE TRIGGER question_answer_stays BEFORE DELETE ON question_answer
  BEGIN SELECT RAISE(ABORT, 'answers to questions are never deleted'); END;
