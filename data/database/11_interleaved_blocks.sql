-- Layout 11: blocks whose trials are mixed. Nothing of older sessions, in which an answer was taken
-- back while no other block was under way.

DROP VIEW design_in_force;

-- Trials that were drawn and run, or will be. When an answer is taken back, those of its block that
-- were drawn for it and had none yet are void: another answer draws others.
CREATE VIEW design_in_force AS
  SELECT d.* FROM design AS d
  WHERE NOT EXISTS
    (SELECT 1 FROM event AS undone
     JOIN design AS its ON its.session = undone.session AND its.trial = undone.trial
     WHERE undone.session = d.session AND undone.kind = 'answer_undone'
       AND its.stage = d.stage AND its.sequence < d.sequence AND undone.sequence > d.sequence
       AND NOT EXISTS
         (SELECT 1 FROM trial AS t
          WHERE t.session = d.session AND t.trial = d.trial AND t.sequence < undone.sequence
            AND NOT EXISTS
              (SELECT 1 FROM event AS later
               WHERE later.session = t.session AND later.supersedes = t.sequence
                 AND later.sequence < undone.sequence)));
