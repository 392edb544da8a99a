% A PI controller in Octave for case_tcp.toml: protocol "hotint", one input, one output.
%
%   octave client.m &                      needs the package instrument-control
%   hydrodae-solve case_tcp.toml -o results.h5
%
% The run listens at 127.0.0.1:50000 (another port: octave client.m PORT). It sends [t, rate, flag],
% and takes [load, flag], as little-endian doubles.
1;

function bytes = receive (run, count)
  % All of so many bytes; fewer when the run has gone.
  bytes = uint8 ([]);
  while numel (bytes) < count
    got = read (run, count - numel (bytes));
    if isempty (got)
      return;
    end
    bytes = [bytes, reshape(uint8 (got), 1, [])];
  end
end

function run = meet (port)
  % Tries until the run listens.
  for tries = 1:600
    try
      run = tcpclient ("127.0.0.1", port, "Timeout", 60);
      return;
    catch
      pause (0.1);
    end
  end
  error ("client: no run listens");
end

period = 0.05; gain_p = 600.0; gain_i = 300.0;   % s, N s/m, N/m
port = 50000;
pkg load instrument-control
words = argv ();
if ! isempty (words)
  port = str2double (words{end});
end

run = meet (port);
integral = 0.0;
while true
  bytes = receive (run, 24);
  if numel (bytes) < 24
    break;
  end
  frame = typecast (bytes, "double");              % t, rate, flag
  if frame(3) >= 2.0                               % 2: ended by an error, 3: ended
    break;
  end
  e = -frame(2);
  u = gain_p * e + integral;
  integral = integral + period * gain_i * e;
  write (run, typecast ([u, 0.0], "uint8"));
end
clear run
