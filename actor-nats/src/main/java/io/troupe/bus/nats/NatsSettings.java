package io.troupe.bus.nats;

import java.net.URI;
import java.net.URISyntaxException;
import java.time.Duration;
import java.util.List;
import java.util.Objects;
import javax.net.ssl.SSLContext;
import org.jspecify.annotations.Nullable;

/**
 * How to reach a NATS server; immutable.
 *
 * {@snippet :
 * var settings = NatsSettings.at("nats://base:4222")
 *         .withUser("robot1", password)
 *         .withApplication("warehouse");
 * }
 *
 * @param servers addresses like {@code nats://HOST:4222}, or {@code tls://HOST:4222} for an encrypted connection; one
 *     is enough, because a server names the others of its cluster
 * @param application separates applications that use one server: the first part of all subjects
 * @param user null if the server asks for none
 * @param password null if there is no user
 * @param tls trusts the server and identifies this process; null = the machine's certificates, if the address begins
 *     with {@code tls:}
 * @param connectLimit the time limit of the first connection, and of the question whether the name is free
 */
public record NatsSettings(
        List<String> servers,
        String application,
        @Nullable String user,
        @Nullable String password,
        @Nullable SSLContext tls,
        Duration connectLimit) {
    public NatsSettings {
        servers = List.copyOf(servers);
        if (servers.isEmpty()) {
            throw new IllegalArgumentException("no address of a server is given, expected one like nats://HOST:4222");
        }
        servers.forEach(NatsSettings::check);
        if (!application.matches("[A-Za-z0-9_-]+")) {
            throw new IllegalArgumentException(
                    "the name of the application is \"" + application + "\", expected letters, digits, - and _");
        }
        if ((user == null) != (password == null)) {
            throw new IllegalArgumentException("expected a user and a password, or neither");
        }
        Objects.requireNonNull(connectLimit, "connectLimit");
    }

    private static void check(String server) {
        String scheme;
        String host;
        try {
            var address = new URI(server);
            scheme = String.valueOf(address.getScheme());
            host = address.getHost();
            if (address.getUserInfo() != null) {
                throw new IllegalArgumentException(
                        "the address of the server has a password in it, which is easily shown to others: use withUser");
            }
        } catch (URISyntaxException malformed) {
            throw new IllegalArgumentException(
                    "the address of the server is \"" + server + "\", expected one like nats://HOST:4222", malformed);
        }
        if (host == null || !List.of("nats", "tls", "ws", "wss").contains(scheme)) {
            throw new IllegalArgumentException(
                    "the address of the server is \"" + server + "\", expected one like nats://HOST:4222");
        }
    }

    /** Settings for one server, without user and password, for the application {@code troupe}. */
    public static NatsSettings at(String server) {
        return new NatsSettings(List.of(server), "troupe", null, null, null, Duration.ofSeconds(5));
    }

    public NatsSettings withUser(String newUser, String newPassword) {
        return new NatsSettings(servers, application, newUser, newPassword, tls, connectLimit);
    }

    public NatsSettings withTls(SSLContext context) {
        return new NatsSettings(servers, application, user, password, context, connectLimit);
    }

    public NatsSettings withApplication(String name) {
        return new NatsSettings(servers, name, user, password, tls, connectLimit);
    }

    public NatsSettings withConnectLimit(Duration limit) {
        return new NatsSettings(servers, application, user, password, tls, limit);
    }

    /** Without the password. */
    @Override
    public String toString() {
        return String.join(", ", servers) + ", application " + application + (user == null ? "" : ", user " + user);
    }
}
