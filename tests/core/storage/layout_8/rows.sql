-- To the trial of session 5 a question was answered.
INSERT INTO event (session, sequence, kind, version, time_ns, stage, trial, attempt, first_tick,
                   last_tick, intensity, supersedes, data)
VALUES (5, 10, 'question_answered', 1, 3000000000, NULL, 1, 1, NULL, NULL, NULL, NULL,
        '{"answer":"4","question":"confidence"}');

INSERT INTO question_answer (session, trial, attempt, sequence, block, question, answer)
VALUES (5, 1, 1, 10, 'estimation', 'confidence', '4');
