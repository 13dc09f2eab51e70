-- Session 9: one trial, whose participant answered by a pedal.
INSERT INTO session (session, participant, protocol_sha256, seed, cells, pilot, simulated, device,
                     laboratory, program_version, realtime, rate_hz, recorded, started_time_ns)
VALUES (9, 'P09', '44136fa355b3678a1146ad16f7e8649e94fb4fc21fe77e8310c060f61caaff8a', '9', '', 0, 1,
        'lumped', '', '0.12.0', 'simulated', 1000.0, 0, 240000000000);

INSERT INTO event (session, sequence, kind, version, time_ns, stage, trial, attempt, first_tick,
                   last_tick, intensity, supersedes, data)
VALUES
  (9, 1, 'session_started', 1, 0, NULL, NULL, NULL, NULL, NULL, NULL, NULL, '{}'),
  (9, 2, 'stage_entered', 1, 0, 0, NULL, NULL, NULL, NULL, NULL, NULL, '{}'),
  (9, 3, 'trials_drawn', 1, 0, 0, 1, NULL, NULL, NULL, NULL, NULL,
   '{"trials":[{"intensity":16.0,"position":1,"reference_intensity":8.0,"repetition":1,"series":1,"starting_intensity":null,"target_percent":null,"test_interval":2}]}'),
  (9, 4, 'trial_started', 1, 0, NULL, 1, 1, 0, NULL, NULL, NULL, '{}'),
  (9, 5, 'trial_answered', 1, 2000000000, NULL, 1, 1, NULL, 1999, NULL, NULL,
   '{"answered_by":"participant","control":"0c45:7403 FootSwitch/KEY_B","control_monotonic_s":241.5,"response":1.0,"response_time_s":2.0}'),
  (9, 6, 'session_ended_early', 1, 2000000000, NULL, NULL, NULL, NULL, NULL, NULL, NULL,
   '{"reason":"enough"}');

INSERT INTO design (session, trial, stage, block, procedure, medium, quantity, repetition, position,
                    intensity, reference_intensity, sequence, series, test_interval, is_catch)
VALUES
  (9, 1, 0, 'low', 'staircase', 'viscous', 'viscosity_pa_s', 1, 1, 16.0, 8.0, 3, 1, 2, 0);

INSERT INTO trial (session, trial, attempt, sequence, block, procedure, medium, quantity, repetition,
                   position, intensity, reference_intensity, response, response_time_s,
                   num_presentations, num_steps, first_tick, last_tick, series, test_interval,
                   is_catch, answered_by, control, control_monotonic_s)
VALUES
  (9, 1, 1, 5, 'low', 'staircase', 'viscous', 'viscosity_pa_s', 1, 1, 16.0, 8.0, 1.0, 2.0, 1, 0, 0,
   1999, 1, 2, 0, 'participant', '0c45:7403 FootSwitch/KEY_B', 241.5);
