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

    RawClient(int port) throws IOException {
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
    }

    /** Connects and reads the greeting. */
    static RawClient greeted(int port) throws IOException {
        var client = new RawClient(port);
        assertThat(client.banner()).startsWith("Player v.");
        return client;
    }

    String banner() throws IOException {
        byte[] banner = in.readNBytes(32);
        assertThat(banner).hasSize(32);
        return new String(banner, StandardCharsets.US_ASCII).replace("\0", "");
    }

    RawClient send(byte[]... bytes) throws IOException {
        var all = new ByteArrayOutputStream();
        for (byte[] each : bytes) {
            all.writeBytes(each);
        }
        socket.getOutputStream().write(all.toByteArray());
        return this;
    }

    static byte[] message(MessageType type, int code, int index, Content content) {
        return WireMessage.of(new DeviceAddress(0, 0, code, index), type, content.subtype(), 0, content.payload())
                .bytes();
    }

    static byte[] request(int code, int index, Content content) {
        return message(MessageType.REQ, code, index, content);
    }

    static byte[] bytes(PlayerRequest request) {
        return request(1, 0, PlayerDeviceCodec.encode(request));
    }

    static PlayerRequest access(Interfaces type, int mode) {
        return new PlayerRequest.Access(new DeviceAddress(0, 0, type.code(), 0), mode);
    }

    /** Sends a request and expects an ACK as the very next message. */
    WireMessage ask(PlayerRequest request) throws IOException {
        WireMessage reply = send(bytes(request)).next();
        assertThat(reply.header().type()).as("reply to %s", request).isEqualTo(MessageType.ACK);
        assertThat(reply.header().subtype())
                .isEqualTo(PlayerDeviceCodec.encode(request).subtype());
        return reply;
    }

    /** Waits until everything that was sent before has been handled. */
    WireMessage sync() throws IOException {
        return ask(new PlayerRequest.DeviceList());
    }

    void subscribe(Interfaces... types) throws IOException {
        for (var type : types) {
            ask(access(type, PlayerRequest.OPEN));
        }
    }

    RawClient drive(double forwardMps, double turnRadps) throws IOException {
        var velocity = new DeviceCommand.Velocity(forwardMps, 0, turnRadps, true);
        return send(message(MessageType.CMD, 4, 0, CommandCodec.encode(velocity)));
    }

    WireMessage next() throws IOException {
        try {
            WireMessage message = reader.read();
            assertThat(message).as("the next message").isNotNull();
            return message;
        } catch (WireException e) {
            throw new AssertionError(e);
        }
    }

    WireMessage next(MessageType type, int code, int subtype) throws IOException {
        WireMessage message = next();
        var expected = WireMessage.of(new DeviceAddress(0, 0, code, 0), type, subtype, 0, message.payload());
        assertThat(message).as("the next message").hasToString(expected.toString());
        return message;
    }

    DeviceData.Position2d nextPosition() throws IOException {
        try {
            byte[] payload = next(MessageType.DATA, 4, 1).payload();
            return (DeviceData.Position2d) DataCodec.decode(4, 1, payload).orElseThrow();
        } catch (WireException e) {
            throw new AssertionError(e);
        }
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
