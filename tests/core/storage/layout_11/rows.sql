-- The trial of session 7 was set aside, and taken in again.
INSERT INTO event (session, sequence, kind, version, time_ns, stage, trial, attempt, first_tick,
                   last_tick, intensity, supersedes, data)
VALUES (7, 8, 'trial_excluded', 1, 3000000000, NULL, 1, NULL, NULL, NULL, NULL, NULL,
        '{"reason":"a rehearsal"}'),
       (7, 9, 'trial_included', 1, 3000000000, NULL, 1, NULL, NULL, NULL, NULL, NULL,
        '{"reason":"it was none"}');
