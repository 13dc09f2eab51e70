-- Session 8: two blocks whose trials are mixed. The answer to the first trial is taken back while
-- a trial of the other block was drawn behind it, which stays.
INSERT INTO session (session, participant, protocol_sha256, seed, cells, pilot, simulated, device,
                     laboratory, program_version, realtime, rate_hz, recorded, started_time_ns)
VALUES (8, 'P08', '44136fa355b3678a1146ad16f7e8649e94fb4fc21fe77e8310c060f61caaff8a', '8', '', 0, 1,
        'lumped', '', '0.11.0', 'simulated', 1000.0, 0, 230000000000);

INSERT INTO event (session, sequence, kind, version, time_ns, stage, trial, attempt, first_tick,
                   last_tick, intensity, supersedes, data)
VALUES
  (8, 1, 'session_started', 1, 0, NULL, NULL, NULL, NULL, NULL, NULL, NULL, '{}'),
  (8, 2, 'stage_entered', 1, 0, 0, NULL, NULL, NULL, NULL, NULL, NULL, '{"num_together":2}'),
  (8, 3, 'trials_drawn', 1, 0, 0, 1, NULL, NULL, NULL, NULL, NULL,
   '{"trials":[{"intensity":16.0,"position":1,"reference_intensity":8.0,"repetition":1,"series":1,"starting_intensity":null,"target_percent":null,"test_interval":2}]}'),
  (8, 4, 'turn_taken', 1, 0, 0, NULL, NULL, NULL, NULL, NULL, NULL, '{}'),
  (8, 5, 'trial_started', 1, 0, NULL, 1, 1, 0, NULL, NULL, NULL, '{}'),
  (8, 6, 'trial_answered', 1, 2000000000, NULL, 1, 1, NULL, 1999, NULL, NULL,
   '{"response":0.0,"response_time_s":2.0}'),
  (8, 7, 'trials_drawn', 1, 2000000000, 1, 2, NULL, NULL, NULL, NULL, NULL,
   '{"trials":[{"intensity":24.0,"position":1,"reference_intensity":8.0,"repetition":1,"series":1,"starting_intensity":null,"target_percent":null,"test_interval":1}]}'),
  (8, 8, 'answer_undone', 1, 2000000000, NULL, 1, 1, NULL, NULL, NULL, 6,
   '{"reason":"slipped"}'),
  (8, 9, 'session_ended_early', 1, 2000000000, NULL, NULL, NULL, NULL, NULL, NULL, NULL,
   '{"reason":"enough"}');

INSERT INTO design (session, trial, stage, block, procedure, medium, quantity, repetition, position,
                    intensity, reference_intensity, sequence, series, test_interval, is_catch)
VALUES
  (8, 1, 0, 'low', 'staircase', 'viscous', 'viscosity_pa_s', 1, 1, 16.0, 8.0, 3, 1, 2, 0),
  (8, 2, 1, 'high', 'staircase', 'viscous', 'viscosity_pa_s', 1, 1, 24.0, 8.0, 7, 1, 1, 0);

INSERT INTO trial (session, trial, attempt, sequence, block, procedure, medium, quantity, repetition,
                   position, intensity, reference_intensity, response, response_time_s,
                   num_presentations, num_steps, first_tick, last_tick, series, test_interval,
                   is_catch)
VALUES
  (8, 1, 1, 6, 'low', 'staircase', 'viscous', 'viscosity_pa_s', 1, 1, 16.0, 8.0, 0.0, 2.0, 1, 0, 0,
   1999, 1, 2, 0);
