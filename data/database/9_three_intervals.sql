-- Layout 9: trials of three intervals. Nothing of older sessions, which had two at most.

-- What each interval held, a letter each: r the reference, t the test.
ALTER TABLE design ADD COLUMN intervals TEXT NOT NULL DEFAULT '';
ALTER TABLE trial ADD COLUMN intervals TEXT NOT NULL DEFAULT '';
-- Which of them is the right answer, from 1.
ALTER TABLE design ADD COLUMN right_interval INTEGER;
ALTER TABLE trial ADD COLUMN right_interval INTEGER;
-- Which of them was chosen, from 1.
ALTER TABLE trial ADD COLUMN chosen_interval INTEGER;
