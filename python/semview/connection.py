# SPDX-License-Identifier: Apache-2.0
"""Frames in and out: one request after the other over a DEALER socket."""
import itertools
import time

import zmq
from google.protobuf.message import DecodeError

from .v1 import envelope_pb2 as envelope

PROTOCOL_VERSION = 1


class SemviewError(Exception):
    """What a server, or the way to it, answered instead of a result.

    code            gRPC's name, for example "NOT_FOUND"
    field           the request's field at fault, or ""
    hint            what to do about it, or ""
    retry_after_ms  > 0: the same call may succeed after this time
    """

    def __init__(self, code, message, field="", hint="", retry_after_ms=0):
        super().__init__(f"{code}: {message}" + (f" ({hint})" if hint else ""))
        self.code = code
        self.message = message
        self.field = field
        self.hint = hint
        self.retry_after_ms = retry_after_ms


def _error(wire):
    name = "UNKNOWN"
    if wire.code in envelope.ErrorCode.values():
        name = envelope.ErrorCode.Name(wire.code)[len("ERROR_CODE_"):]
    return SemviewError(name, wire.message, wire.field, wire.hint, wire.retry_after_ms)


def _no_endpoint(endpoint):
    return SemviewError(
        "INVALID_ARGUMENT",
        f"{endpoint!r} is not an endpoint; expected tcp://HOST:PORT, for example tcp://127.0.0.1:5560",
        "endpoint",
    )


class Connection:
    """Not for several threads at once; several connections may live in one program."""

    def __init__(self, endpoint, timeout_s=30.0, client_name="python"):
        if not isinstance(endpoint, str) or not endpoint.startswith("tcp://"):
            raise _no_endpoint(endpoint)
        self.endpoint = endpoint
        self.timeout_s = timeout_s
        self.client_name = client_name
        self.server_epoch = 0
        self._ids = itertools.count(1)
        self._context = zmq.Context.instance()
        self._socket = None
        self._connect()

    def _connect(self):
        """A new socket: a late reply to an old request cannot be taken for a new one's."""
        if self._socket is not None:
            self._socket.close(linger=0)
        self._socket = self._context.socket(zmq.DEALER)
        self._socket.linger = 0
        try:
            self._socket.connect(self.endpoint)
        except zmq.ZMQError as error:
            self.close()
            raise _no_endpoint(self.endpoint) from error

    def close(self):
        self._socket.close(linger=0)

    def call(self, method, request, reply_type, timeout_s=None):
        """The reply to one request, or a SemviewError."""
        timeout_s = self.timeout_s if timeout_s is None else timeout_s
        header = envelope.RequestHeader(
            request_id=next(self._ids),
            method=method,
            protocol_version=PROTOCOL_VERSION,
            deadline_ms=max(1, int(timeout_s * 1000)),
            client_name=self.client_name,
        )
        self._socket.send_multipart([header.SerializeToString(), request.SerializeToString()])
        end = time.monotonic() + timeout_s
        while True:
            left_ms = int((end - time.monotonic()) * 1000)
            if left_ms <= 0 or not self._socket.poll(left_ms):
                self._connect()
                raise SemviewError(
                    "UNAVAILABLE",
                    f"nothing answered at {self.endpoint} within {timeout_s:g} s",
                    hint="is semview-server running there?",
                )
            frames = self._socket.recv_multipart()
            try:
                answer = envelope.ReplyHeader.FromString(frames[0])
                if answer.request_id != header.request_id:
                    continue
                self.server_epoch = answer.server_epoch
                if answer.HasField("error"):
                    raise _error(answer.error)
                return reply_type.FromString(frames[1])
            except (DecodeError, IndexError) as error:
                raise SemviewError("DATA_LOSS", "a reply that cannot be read") from error
