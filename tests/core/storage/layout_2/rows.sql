-- A participant who withdrew, backups that are known and forgotten, a second study file, and that
-- somebody opened the study to the eye. The identity is no drawn one, so that tests can name it.
UPDATE study_identity SET study_id = '0123456789abcdef0123456789abcdef';

INSERT INTO protocol (sha256, file_name, text, relative_path) VALUES
  ('44136fa355b3678a1146ad16f7e8649e94fb4fc21fe77e8310c060f61caaff8a', 'second.json', '{}',
   '../second.json');

INSERT INTO backup (backup, folder, time_ns, forgotten) VALUES
  (1, '/backups/kept.study', 50000000000, 0),
  (2, '/backups/lost.study', 51000000000, 0),
  (3, '/backups/lost.study', 52000000000, 1);

INSERT INTO withdrawal (session, participant, time_ns, num_events, num_trials) VALUES
  (2, 'P02', 60000000000, 6, 1);

INSERT INTO unblinding (time_ns, reason) VALUES (70000000000, 'a look at the first results');
