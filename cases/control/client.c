/* A PI controller in plain C for case_tcp.toml: protocol "hotint", one input, one output.

     cc -O2 client.c -o client
     ./client &
     hydrodae-solve case_tcp.toml -o results.h5

   The run listens at 127.0.0.1:50000. It sends [t, rate, flag], and takes [load, flag]. */
#include <arpa/inet.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <stdio.h>
#include <stdlib.h>
#include <sys/socket.h>
#include <unistd.h>

/* All of so many bytes; 0 when the run has gone. */
static int receive(int run, void* bytes, size_t count) {
  char* next = bytes;
  while (count > 0) {
    const ssize_t got = recv(run, next, count, 0);
    if (got <= 0)
      return 0;
    next += got;
    count -= (size_t)got;
  }
  return 1;
}

static int meet(unsigned short port) {
  struct sockaddr_in place = {0};
  place.sin_family = AF_INET;
  place.sin_port = htons(port);
  place.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  for (int tries = 0; tries < 600; ++tries) {
    const int run = socket(AF_INET, SOCK_STREAM, 0), yes = 1;
    setsockopt(run, IPPROTO_TCP, TCP_NODELAY, &yes, sizeof yes);
    if (connect(run, (struct sockaddr*)&place, sizeof place) == 0)
      return run;
    close(run);
    usleep(100000);
  }
  return -1;
}

int main(int count, char** words) {
  const double period = 0.05, gain_p = 600.0, gain_i = 300.0; /* s, N s/m, N/m */
  double frame[3], answer[2] = {0.0, 0.0}, integral = 0.0;
  const int run = meet(count > 1 ? (unsigned short)atoi(words[1]) : 50000);
  if (run < 0) {
    fprintf(stderr, "client: no run listens\n");
    return 1;
  }
  while (receive(run, frame, sizeof frame) && frame[2] < 2.0) {
    const double error = -frame[1];
    answer[0] = gain_p * error + integral;
    integral += period * gain_i * error;
    if (send(run, answer, sizeof answer, 0) != (ssize_t)sizeof answer)
      break;
  }
  close(run);
  return 0;
}
