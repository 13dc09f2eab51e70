-- Layout 14: a stage that comes several times in a session, for example between three arms.

-- Place of the stage in the participant's own list, from 0. Nothing of what was known before the
-- first stage.
ALTER TABLE answer ADD COLUMN stage_index INTEGER;

DROP VIEW answer_in_force;

-- The last answer given to each item each time that its stage came. Which time an answer of an older
-- session belongs to is told by its event.
CREATE VIEW answer_in_force AS
  SELECT a.session, a.sequence, a.stage, a.item, a.answer,
         COALESCE(a.stage_index, e.stage) AS stage_index
  FROM answer AS a
  LEFT JOIN event AS e ON e.session = a.session AND e.sequence = a.sequence
  WHERE NOT EXISTS
    (SELECT 1 FROM answer AS later
     LEFT JOIN event AS its ON its.session = later.session AND its.sequence = later.sequence
     WHERE later.session = a.session AND later.stage = a.stage AND later.item = a.item
       AND later.sequence > a.sequence
       AND COALESCE(later.stage_index, its.stage) IS COALESCE(a.stage_index, e.stage))
    AND NOT EXISTS (SELECT 1 FROM superseded AS s
                    WHERE s.session = a.session AND s.sequence = a.sequence);
