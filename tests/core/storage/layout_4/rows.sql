-- A session with a staircase, whose first answer is taken back: the trial that was drawn for it is
-- void, and the first one is run again. Then a pair that is the same, a catch trial.
INSERT INTO session (session, participant, protocol_sha256, seed, cells, pilot, simulated, device,
                     laboratory, program_version, realtime, rate_hz, recorded, started_time_ns)
VALUES (4, 'P04', '44136fa355b3678a1146ad16f7e8649e94fb4fc21fe77e8310c060f61caaff8a', '4', '', 0, 1,
        'lumped', '', '0.4.0', 'simulated', 1000.0, 0, 90000000000);

INSERT INTO event (session, sequence, kind, version, time_ns, stage, trial, attempt, first_tick,
                   last_tick, intensity, supersedes, data)
VALUES
  (4, 1, 'session_started', 1, 0, NULL, NULL, NULL, NULL, NULL, NULL, NULL, '{}'),
  (4, 2, 'stage_entered', 1, 0, 0, NULL, NULL, NULL, NULL, NULL, NULL, '{}'),
  (4, 3, 'trials_drawn', 1, 0, 0, 1, NULL, NULL, NULL, NULL, NULL,
   '{"trials":[{"intensity":16.0,"position":1,"reference_intensity":8.0,"repetition":1,"series":1,"starting_intensity":null,"target_percent":null,"test_interval":2}]}'),
  (4, 4, 'trial_started', 1, 0, NULL, 1, 1, 0, NULL, NULL, NULL, '{}'),
  (4, 5, 'presentation_started', 1, 0, NULL, 1, 1, 0, NULL, 16.0, NULL,
   '{"interval":"test","presentation":1}'),
  (4, 6, 'presentation_ended', 1, 2000000000, NULL, 1, 1, NULL, 1999, NULL, NULL,
   '{"commanded_damping_n_s_per_m":null,"delivered_damping_n_s_per_m":null,"finger_lag_s":null,"limited_ticks":0,"max_speed_m_per_s":null,"mean_height_m":null,"num_strokes":1,"presentation":1,"stroke_width_m":null}'),
  (4, 7, 'trial_answered', 1, 2000000000, NULL, 1, 1, NULL, 1999, NULL, NULL,
   '{"response":0.0,"response_time_s":2.0}'),
  (4, 8, 'trials_drawn', 1, 2000000000, 0, 2, NULL, NULL, NULL, NULL, NULL,
   '{"trials":[{"intensity":24.0,"position":2,"reference_intensity":8.0,"repetition":1,"series":1,"starting_intensity":null,"target_percent":null,"test_interval":1}]}'),
  (4, 9, 'answer_undone', 1, 2000000000, NULL, 1, 1, NULL, NULL, NULL, 7,
   '{"reason":"slipped"}'),
  (4, 10, 'trial_started', 1, 2000000000, NULL, 1, 2, 2000, NULL, NULL, NULL, '{}'),
  (4, 11, 'presentation_started', 1, 2000000000, NULL, 1, 2, 2000, NULL, 16.0, NULL,
   '{"interval":"test","presentation":1}'),
  (4, 12, 'presentation_ended', 1, 4000000000, NULL, 1, 2, NULL, 3999, NULL, NULL,
   '{"commanded_damping_n_s_per_m":null,"delivered_damping_n_s_per_m":null,"finger_lag_s":null,"limited_ticks":0,"max_speed_m_per_s":null,"mean_height_m":null,"num_strokes":1,"presentation":1,"stroke_width_m":null}'),
  (4, 13, 'trial_answered', 1, 4000000000, NULL, 1, 2, NULL, 3999, NULL, NULL,
   '{"response":1.0,"response_time_s":2.0}'),
  (4, 14, 'stage_finished', 1, 4000000000, 0, NULL, NULL, NULL, NULL, NULL, NULL, '{}'),
  (4, 15, 'stage_entered', 1, 4000000000, 1, NULL, NULL, NULL, NULL, NULL, NULL, '{}'),
  (4, 16, 'trials_drawn', 1, 4000000000, 1, 3, NULL, NULL, NULL, NULL, NULL,
   '{"trials":[{"intensity":8.0,"is_catch":true,"position":1,"reference_intensity":8.0,"repetition":1,"starting_intensity":null,"target_percent":null,"test_interval":1}]}'),
  (4, 17, 'trial_started', 1, 4000000000, NULL, 3, 1, 4000, NULL, NULL, NULL, '{}'),
  (4, 18, 'presentation_started', 1, 4000000000, NULL, 3, 1, 4000, NULL, 8.0, NULL,
   '{"interval":"test","presentation":1}'),
  (4, 19, 'presentation_ended', 1, 6000000000, NULL, 3, 1, NULL, 5999, NULL, NULL,
   '{"commanded_damping_n_s_per_m":null,"delivered_damping_n_s_per_m":null,"finger_lag_s":null,"limited_ticks":0,"max_speed_m_per_s":null,"mean_height_m":null,"num_strokes":1,"presentation":1,"stroke_width_m":null}'),
  (4, 20, 'trial_answered', 1, 6000000000, NULL, 3, 1, NULL, 5999, NULL, NULL,
   '{"response":0.0,"response_time_s":2.0}'),
  (4, 21, 'stage_finished', 1, 6000000000, 1, NULL, NULL, NULL, NULL, NULL, NULL, '{}'),
  (4, 22, 'session_completed', 1, 6000000000, NULL, NULL, NULL, NULL, NULL, NULL, NULL, '{}');

INSERT INTO design (session, trial, stage, block, procedure, medium, quantity, repetition, position,
                    intensity, reference_intensity, sequence, series, test_interval, is_catch)
VALUES
  (4, 1, 0, 'stairs', 'staircase', 'viscous', 'viscosity_pa_s', 1, 1, 16.0, 8.0, 3, 1, 2, 0),
  (4, 2, 0, 'stairs', 'staircase', 'viscous', 'viscosity_pa_s', 1, 2, 24.0, 8.0, 8, 1, 1, 0),
  (4, 3, 1, 'pairs', 'constant_stimuli', 'viscous', 'viscosity_pa_s', 1, 1, 8.0, 8.0, 16, NULL, 1,
   1);

INSERT INTO presentation (session, trial, attempt, presentation, sequence, interval, intensity,
                          first_tick, last_tick, num_strokes, limited_ticks)
VALUES
  (4, 1, 1, 1, 6, 'test', 16.0, 0, 1999, 1, 0),
  (4, 1, 2, 1, 12, 'test', 16.0, 2000, 3999, 1, 0),
  (4, 3, 1, 1, 19, 'test', 8.0, 4000, 5999, 1, 0);

INSERT INTO trial (session, trial, attempt, sequence, block, procedure, medium, quantity, repetition,
                   position, intensity, reference_intensity, response, response_time_s,
                   num_presentations, num_steps, first_tick, last_tick, series, test_interval,
                   is_catch)
VALUES
  (4, 1, 1, 7, 'stairs', 'staircase', 'viscous', 'viscosity_pa_s', 1, 1, 16.0, 8.0, 0.0, 2.0, 1, 0,
   0, 1999, 1, 2, 0),
  (4, 1, 2, 13, 'stairs', 'staircase', 'viscous', 'viscosity_pa_s', 1, 1, 16.0, 8.0, 1.0, 2.0, 1, 0,
   2000, 3999, 1, 2, 0),
  (4, 3, 1, 20, 'pairs', 'constant_stimuli', 'viscous', 'viscosity_pa_s', 1, 1, 8.0, 8.0, 0.0, 2.0,
   1, 0, 4000, 5999, NULL, 1, 1);
