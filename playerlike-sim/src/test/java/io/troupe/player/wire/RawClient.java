package io.troupe.player.wire;

import static org.assertj.core.api.Assertions.assertThat;

import java.io.ByteArrayOutputStream;
import java.io.FilterInputStream;
import java.io.IOException;
import java.io.InputStream;
import java.io.UncheckedIOException;
import java.net.InetAddress;
import java.net.Socket;
import java.net.SocketTimeoutException;
import java.nio.charset.StandardCharsets;

/** A client that sends and receives raw bytes, independent of our client library. */
final class RawClient implements AutoCloseable {
    private static final int PATIENCE_MILLIS = 20_000;

    final Socket socket;
    private final ByteArrayOutputStream received = new ByteArrayOutputStream();
    private final InputStream in;
    private final MessageReader reader;

    RawClient(int port) {
        try {
            socket = new Socket(InetAddress.getLoopbackAddress(), port);
            socket.setSoTimeout(PATIENCE_MILLIS);
            socket.setTcpNoDelay(true);
            in = new FilterInputStream(socket.getInputStream()) {
                @Override
                public int read(byte[] bytes, int offset, int length) throws IOException {
                    int count = super.read(bytes, offset, length);
                    received.write(bytes, offset, Math.max(0, count));
                    return count;
                }
            };
            reader = new MessageReader(in, 1 << 20);
        } catch (IOException e) {
            throw new UncheckedIOException(e);
        }
    }

    /** Connects and reads the greeting. */
    static RawClient greeted(int port) {
        var client = new RawClient(port);
        assertThat(client.banner()).startsWith("Player v.");
        return client;
    }

    String banner() {
        try {
            byte[] banner = in.readNBytes(32);
            assertThat(banner).hasSize(32);
            return new String(banner, StandardCharsets.US_ASCII).replace("\0", "");
        } catch (IOException e) {
            throw new UncheckedIOException(e);
        }
    }

    RawClient send(byte[]... bytes) {
        try {
            var all = new ByteArrayOutputStream();
            for (byte[] each : bytes) {
                all.writeBytes(each);
            }
            socket.getOutputStream().write(all.toByteArray());
            return this;
        } catch (IOException e) {
            throw new UncheckedIOException(e);
        }
    }

    static byte[] message(MessageType type, int code, int index, Content content) {
        return WireMessage.of(new DeviceAddress(0, 0, code, index), type, content.subtype(), 0, content.payload())
                .bytes();
    }

    static byte[] bytes(PlayerRequest request) {
        return message(MessageType.REQ, 1, 0, PlayerDeviceCodec.encode(request));
    }

    static byte[] access(Interfaces type, int mode) {
        return bytes(new PlayerRequest.Access(new DeviceAddress(0, 0, type.code(), 0), mode));
    }

    RawClient send(PlayerRequest request) {
        return send(bytes(request));
    }

    /** Sends a request and expects an ACK as the very next message. */
    WireMessage ask(PlayerRequest request) {
        send(request);
        WireMessage reply = next();
        assertThat(reply.header().type()).as("reply to %s", request).isEqualTo(MessageType.ACK);
        assertThat(reply.header().subtype())
                .isEqualTo(PlayerDeviceCodec.encode(request).subtype());
        return reply;
    }

    void subscribe(Interfaces type) {
        ask(new PlayerRequest.Access(new DeviceAddress(0, 0, type.code(), 0), PlayerRequest.OPEN));
    }

    RawClient drive(double forwardMps, double turnRadps) {
        return send(message(
                MessageType.CMD,
                4,
                0,
                CommandCodec.encode(new DeviceCommand.Velocity(forwardMps, 0, turnRadps, true))));
    }

    WireMessage next() {
        try {
            WireMessage message = reader.read();
            assertThat(message).as("the next message").isNotNull();
            return message;
        } catch (IOException e) {
            throw new UncheckedIOException(e);
        } catch (WireException e) {
            throw new AssertionError(e);
        }
    }

    WireMessage next(MessageType type, int code, int subtype) {
        WireMessage message = next();
        assertThat(message)
                .as("the next message")
                .hasToString(WireMessage.of(new DeviceAddress(0, 0, code, 0), type, subtype, 0, message.payload())
                        .toString());
        return message;
    }

    DeviceData.Position2d nextPosition() throws WireException {
        return (DeviceData.Position2d)
                DataCodec.decode(4, 1, next(MessageType.DATA, 4, 1).payload()).orElseThrow();
    }

    /** Waits until the server has closed the connection. */
    void awaitEnd() {
        try {
            while (in.read(new byte[4096], 0, 4096) >= 0) {
                // what was still in transit
            }
        } catch (SocketTimeoutException e) {
            throw new AssertionError("the server did not end the connection", e);
        } catch (IOException reset) {
            // a reset ends the connection too
        }
    }

    /** All bytes read so far. */
    byte[] received() {
        return received.toByteArray();
    }

    @Override
    public void close() {
        try {
            socket.close();
        } catch (IOException e) {
            throw new UncheckedIOException(e);
        }
    }
}
