package io.troupe.bus.nats;

import io.troupe.actor.Settings;
import java.net.URI;
import java.net.URISyntaxException;
import java.time.Duration;
import java.util.List;
import java.util.Objects;
import javax.net.ssl.SSLContext;
import org.jspecify.annotations.Nullable;

/**
 * How to reach a NATS server.
 *
 * {@snippet :
 * var settings = NatsSettings.at("nats://base:4222")
 *         .withUser("robot1", password)
 *         .withApplication("warehouse");
 * }
 */
public final class NatsSettings extends Settings<NatsSettings> {
    private List<String> servers;
    private String application = "troupe";
    private @Nullable String user;
    private @Nullable String password;
    private @Nullable SSLContext tls;
    private Duration connectLimit = Duration.ofSeconds(5);

    private NatsSettings(List<String> servers) {
        this.servers = servers;
        check();
    }

    /**
     * Settings for one server, without user and password, for the application {@code troupe}.
     *
     * @param server an address like {@code nats://HOST:4222}, or {@code tls://HOST:4222} for an encrypted connection
     */
    public static NatsSettings at(String server) {
        return new NatsSettings(List.of(server));
    }

    @Override
    protected void check() {
        if (servers.isEmpty()) {
            throw new IllegalArgumentException("no address of a server is given, expected one like nats://HOST:4222");
        }
        servers.forEach(NatsSettings::checkServer);
        if (!application.matches("[A-Za-z0-9_-]+")) {
            throw new IllegalArgumentException(
                    "the name of the application is \"" + application + "\", expected letters, digits, - and _");
        }
    }

    private static void checkServer(String server) {
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

    /** Several servers of a cluster; one is enough, because a server names the others. */
    public NatsSettings withServers(List<String> addresses) {
        List<String> all = List.copyOf(addresses);
        return with(copy -> copy.servers = all);
    }

    /** The user of this process, if the server asks for one. */
    public NatsSettings withUser(String newUser, String newPassword) {
        Objects.requireNonNull(newUser, "user");
        Objects.requireNonNull(newPassword, "password");
        return with(copy -> {
            copy.user = newUser;
            copy.password = newPassword;
        });
    }

    /**
     * Trusts the server and identifies this process; by default the machine's certificates do, if the address begins
     * with {@code tls:}.
     */
    public NatsSettings withTls(SSLContext context) {
        Objects.requireNonNull(context, "context");
        return with(copy -> copy.tls = context);
    }

    /** Separates applications that use one server: the first part of all subjects. */
    public NatsSettings withApplication(String name) {
        Objects.requireNonNull(name, "application");
        return with(copy -> copy.application = name);
    }

    /**
     * The time limit of the first connection, and of the request that asks whether the name is free; by default 5 s.
     */
    public NatsSettings withConnectLimit(Duration limit) {
        Objects.requireNonNull(limit, "connectLimit");
        return with(copy -> copy.connectLimit = limit);
    }

    public List<String> servers() {
        return servers;
    }

    public String application() {
        return application;
    }

    public @Nullable String user() {
        return user;
    }

    public @Nullable String password() {
        return password;
    }

    public @Nullable SSLContext tls() {
        return tls;
    }

    public Duration connectLimit() {
        return connectLimit;
    }

    /** Without the password. */
    @Override
    public String toString() {
        return String.join(", ", servers) + ", application " + application + (user == null ? "" : ", user " + user);
    }
}
