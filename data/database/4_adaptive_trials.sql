-- Layout 4: procedures that draw a trial when they know the answer before, and intervals in drawn
-- order. Nothing of older sessions, whose trials came in one series, the reference first.

-- The event that drew the trial.
ALTER TABLE design ADD COLUMN sequence INTEGER;
-- Which staircase or series of the block the trial belongs to, from 1.
ALTER TABLE design ADD COLUMN series INTEGER;
ALTER TABLE trial ADD COLUMN series INTEGER;
-- In which interval the test stimulus comes, 1 or 2, where the order is drawn.
ALTER TABLE design ADD COLUMN test_interval INTEGER;
ALTER TABLE trial ADD COLUMN test_interval INTEGER;
-- A catch trial: nothing is there to be found, or test and reference are the same.
ALTER TABLE design ADD COLUMN is_catch INTEGER;
ALTER TABLE trial ADD COLUMN is_catch INTEGER;

CREATE INDEX undone_answer ON event (session, sequence) WHERE kind = 'answer_undone';

-- Trials that were drawn and run, or will be. When an answer is taken back, those that were drawn
-- for it and had none yet are void: another answer draws others.
CREATE VIEW design_in_force AS
  SELECT d.* FROM design AS d
  WHERE NOT EXISTS
    (SELECT 1 FROM event AS undone
     JOIN design AS its ON its.session = undone.session AND its.trial = undone.trial
     WHERE undone.session = d.session AND undone.kind = 'answer_undone'
       AND its.sequence < d.sequence AND undone.sequence > d.sequence
       AND NOT EXISTS
         (SELECT 1 FROM trial AS t
          WHERE t.session = d.session AND t.trial = d.trial AND t.sequence < undone.sequence
            AND NOT EXISTS
              (SELECT 1 FROM event AS later
               WHERE later.session = t.session AND later.supersedes = t.sequence
                 AND later.sequence < undone.sequence)));
