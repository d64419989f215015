package io.troupe.player;

import io.troupe.player.wire.PlayerServer;
import java.util.Map;
import java.util.Objects;
import java.util.Optional;
import java.util.concurrent.ConcurrentSkipListMap;

/**
 * The Player servers that run in this JVM, by port; a client of {@code localhost} finds them here and needs no socket.
 *
 * <p><b>Role.</b> The only registry of this project that is global to the JVM, as real ports are. The code that opens a
 * port must close it.
 *
 * <p><b>Threads.</b> Any thread.
 */
public final class PlayerPorts {
    private static final Map<Integer, PlayerServer> OPEN = new ConcurrentSkipListMap<>();

    /** An open port. */
    public interface Registration extends AutoCloseable {
        @Override
        void close();
    }

    private PlayerPorts() {}

    /**
     * Opens a port.
     *
     * @throws PlayerException if the port is open already
     */
    public static Registration open(int port, PlayerServer server) {
        Objects.requireNonNull(server, "server");
        if (port < 1 || port > 65_535) {
            throw new PlayerException("port is " + port + ", expected 1 to 65535");
        }
        if (OPEN.putIfAbsent(port, server) != null) {
            throw new PlayerException("port " + port
                    + " is in use by another world in this JVM: close that first, or choose another port");
        }
        return () -> OPEN.remove(port, server);
    }

    /** The server that listens on a port. */
    public static Optional<PlayerServer> find(int port) {
        return Optional.ofNullable(OPEN.get(port));
    }

    /** The open ports, for error messages. */
    static String list() {
        return OPEN.isEmpty() ? "none" : OPEN.keySet().toString();
    }
}
