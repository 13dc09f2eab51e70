-- A session of one trial, in whose presentation the loop was held up for three ticks.
INSERT INTO session (session, participant, protocol_sha256, seed, cells, pilot, simulated, device,
                     laboratory, program_version, realtime, rate_hz, recorded, started_time_ns)
VALUES (5, 'P05', '44136fa355b3678a1146ad16f7e8649e94fb4fc21fe77e8310c060f61caaff8a', '5', '', 0, 1,
        'lumped', '', '0.5.0', 'simulated', 1000.0, 0, 100000000000);

INSERT INTO event (session, sequence, kind, version, time_ns, stage, trial, attempt, first_tick,
                   last_tick, intensity, supersedes, data)
VALUES
  (5, 1, 'session_started', 1, 0, NULL, NULL, NULL, NULL, NULL, NULL, NULL, '{}'),
  (5, 2, 'stage_entered', 1, 0, 0, NULL, NULL, NULL, NULL, NULL, NULL, '{}'),
  (5, 3, 'trials_drawn', 1, 0, 0, 1, NULL, NULL, NULL, NULL, NULL,
   '{"trials":[{"intensity":2.0,"position":1,"reference_intensity":null,"repetition":1,"starting_intensity":null,"target_percent":null}]}'),
  (5, 4, 'trial_started', 1, 0, NULL, 1, 1, 0, NULL, NULL, NULL, '{}'),
  (5, 5, 'presentation_started', 1, 0, NULL, 1, 1, 0, NULL, 2.0, NULL,
   '{"interval":"test","presentation":1}'),
  (5, 6, 'presentation_ended', 1, 3000000000, NULL, 1, 1, NULL, 2999, NULL, NULL,
   '{"commanded_damping_n_s_per_m":null,"delivered_damping_n_s_per_m":null,"finger_lag_s":null,"limited_ticks":0,"max_speed_m_per_s":null,"mean_height_m":null,"missed_ticks":3,"num_strokes":1,"presentation":1,"stroke_width_m":null}'),
  (5, 7, 'trial_answered', 1, 3000000000, NULL, 1, 1, NULL, 2999, NULL, NULL,
   '{"response":60.0,"response_time_s":3.0}'),
  (5, 8, 'stage_finished', 1, 3000000000, 0, NULL, NULL, NULL, NULL, NULL, NULL, '{}'),
  (5, 9, 'session_completed', 1, 3000000000, NULL, NULL, NULL, NULL, NULL, NULL, NULL, '{}');

INSERT INTO design (session, trial, stage, block, procedure, medium, quantity, repetition, position,
                    intensity, sequence, is_catch)
VALUES (5, 1, 0, 'estimation', 'magnitude_estimation', 'water', 'scale', 1, 1, 2.0, 3, 0);

INSERT INTO presentation (session, trial, attempt, presentation, sequence, interval, intensity,
                          first_tick, last_tick, num_strokes, limited_ticks, missed_ticks)
VALUES (5, 1, 1, 1, 6, 'test', 2.0, 0, 2999, 1, 0, 3);

INSERT INTO trial (session, trial, attempt, sequence, block, procedure, medium, quantity, repetition,
                   position, intensity, response, response_time_s, num_presentations, num_steps,
                   first_tick, last_tick, is_catch)
VALUES (5, 1, 1, 7, 'estimation', 'magnitude_estimation', 'water', 'scale', 1, 1, 2.0, 60.0, 3.0, 1, 0,
        0, 2999, 0);
