package io.troupe.demo.hosts;

import io.troupe.bus.Bus;
import io.troupe.bus.BusException;
import io.troupe.bus.BusSettings;
import io.troupe.bus.nats.NatsBus;
import io.troupe.bus.nats.NatsSettings;
import io.troupe.demo.terminal.FileProblems;
import java.io.IOException;
import java.io.InputStream;
import java.io.UncheckedIOException;
import java.net.InetAddress;
import java.net.UnknownHostException;
import java.nio.file.Files;
import java.nio.file.Path;
import java.security.GeneralSecurityException;
import java.security.KeyStore;
import java.security.cert.Certificate;
import java.security.cert.CertificateException;
import java.security.cert.CertificateFactory;
import java.util.List;
import java.util.Map;
import javax.net.ssl.SSLContext;
import javax.net.ssl.TrustManagerFactory;
import org.jspecify.annotations.Nullable;
import picocli.CommandLine.Help.Visibility;
import picocli.CommandLine.Mixin;
import picocli.CommandLine.Model.CommandSpec;
import picocli.CommandLine.Option;
import picocli.CommandLine.ParameterException;
import picocli.CommandLine.Spec;

/**
 * Command line options for the bus over hosts, a {@link Mixin} of all commands that use it. The password comes from a
 * file or from the environment, because other users of a machine can read command lines.
 */
public final class BusOptions {
    private static final String PASSWORD_VARIABLE = "TROUPE_BUS_PASSWORD";
    private static final String EXPECTED_ADDRESS = "expected an address like nats://HOST:4222";

    @Spec(Spec.Target.MIXEE)
    private CommandSpec spec;

    @Option(
            names = "--bus",
            paramLabel = "URL",
            split = ",",
            description =
                    "the NATS server: nats://HOST:4222, or tls://HOST:4222 if it is encrypted; several with commas")
    private @Nullable List<String> servers;

    @Option(
            names = "--bus-user",
            paramLabel = "USER",
            description = "a user of the server; the password is in " + PASSWORD_VARIABLE + " or a file")
    private @Nullable String user;

    @Option(names = "--bus-password-file", paramLabel = "FILE", description = "a file whose first line is the password")
    private @Nullable Path passwordFile;

    @Option(
            names = "--bus-trust",
            paramLabel = "FILE",
            description =
                    "the certificate (PEM) of the authority that has signed the server's; the machine's otherwise")
    private @Nullable Path trust;

    @Option(
            names = "--application",
            paramLabel = "NAME",
            description = "separates applications that use one server; troupe unless given",
            showDefaultValue = Visibility.NEVER)
    private @Nullable String application;

    @Option(
            names = "--name",
            paramLabel = "NODE",
            description = "the name of this process on the bus; unless given host and process id, of run: arbitrator")
    private @Nullable String node;

    /** True if the command is to use a bus. */
    public boolean isGiven() {
        return servers != null;
    }

    /**
     * Rejects options that only a bus needs, if there is none.
     *
     * @throws ParameterException with the first such option
     */
    public void refuseWithoutBus() {
        if (servers == null) {
            refuseWithoutBus("--bus-user", user);
            refuseWithoutBus("--bus-password-file", passwordFile);
            refuseWithoutBus("--bus-trust", trust);
            refuseWithoutBus("--application", application);
            refuseWithoutBus("--name", node);
        }
    }

    private void refuseWithoutBus(String option, @Nullable Object value) {
        if (value != null) {
            throw wrong(option + " is " + value + ", but there is no bus: expected --bus as well");
        }
    }

    /** The name of this process on the bus. */
    public String node() {
        if (node == null) {
            return hostName() + "-" + ProcessHandle.current().pid();
        }
        if (node.isBlank() || node.contains("/")) {
            throw wrong("--name is '" + node + "', expected a name without a slash");
        }
        if (node.chars().anyMatch(Character::isISOControl)) {
            throw wrong("--name has a control character in it, expected a name without one");
        }
        return node;
    }

    /**
     * How to reach the server.
     *
     * @throws ParameterException if an option is missing or wrong, or if a file cannot be read
     */
    public NatsSettings settings() {
        return settings(System.getenv());
    }

    /**
     * Opens the bus; the caller closes it.
     *
     * @throws ParameterException as {@link #settings}
     * @throws BusException if the server cannot be reached, or refuses this process; {@code Main} prints it as one line
     */
    public Bus open(BusSettings settings) {
        return NatsBus.open(node(), settings(), settings);
    }

    /** The same with a name that is used unless one is given. */
    public Bus open(String defaultNode, BusSettings settings) {
        return NatsBus.open(node == null ? defaultNode : node(), settings(), settings);
    }

    NatsSettings settings(Map<String, String> environment) {
        if (servers == null || servers.isEmpty()) {
            throw wrong("--bus is missing, " + EXPECTED_ADDRESS);
        }
        NatsSettings settings;
        try {
            settings = NatsSettings.at(servers.getFirst()).withServers(servers);
        } catch (IllegalArgumentException malformed) {
            throw wrong("--bus is " + withoutPassword(servers) + ": " + reason(malformed));
        }
        if (application != null) {
            settings = withApplication(settings, application);
        }
        String password = password(environment);
        if (user != null && password != null) {
            settings = settings.withUser(user, password);
        }
        return trust == null ? settings : settings.withTls(trusting(trust));
    }

    /** The reason without the address, which the error has already. */
    private static String reason(IllegalArgumentException malformed) {
        String message = String.valueOf(malformed.getMessage());
        return message.contains("password") ? message.replace("withUser", "--bus-user") : EXPECTED_ADDRESS;
    }

    private static String withoutPassword(List<String> servers) {
        return String.join(",", servers).replaceAll("//[^@/]*@", "//..@");
    }

    private NatsSettings withApplication(NatsSettings settings, String name) {
        try {
            return settings.withApplication(name);
        } catch (IllegalArgumentException malformed) {
            throw wrong("--application is '" + name + "', expected letters, digits, - and _");
        }
    }

    private @Nullable String password(Map<String, String> environment) {
        if (user == null) {
            if (passwordFile != null) {
                throw wrong("--bus-password-file is " + passwordFile
                        + ", but there is no user: expected --bus-user as well");
            }
            return null;
        }
        String password = passwordFile == null ? environment.get(PASSWORD_VARIABLE) : firstLine(passwordFile);
        if (password == null || password.isEmpty()) {
            throw wrong(
                    passwordFile == null
                            ? "--bus-user is " + user + ", but there is no password: expected --bus-password-file, or "
                                    + PASSWORD_VARIABLE + " in the environment"
                            : passwordFile + ": the first line is empty, expected the password of " + user);
        }
        return password;
    }

    private String firstLine(Path file) {
        FileProblems.input(spec, file, "a file whose first line is the password");
        try (var lines = Files.lines(file)) {
            return lines.findFirst().orElse("");
        } catch (IOException | UncheckedIOException unreadable) {
            throw wrong(file + ": cannot be read, expected a text whose first line is the password");
        }
    }

    private SSLContext trusting(Path file) {
        String expected = "a certificate in the PEM format (-----BEGIN CERTIFICATE-----)";
        FileProblems.input(spec, file, expected);
        try (InputStream content = Files.newInputStream(file)) {
            var certificates = CertificateFactory.getInstance("X.509").generateCertificates(content);
            if (certificates.isEmpty()) {
                throw wrong(file + ": no certificate in it, expected " + expected);
            }
            var store = KeyStore.getInstance(KeyStore.getDefaultType());
            store.load(null, null);
            int number = 0;
            for (Certificate certificate : certificates) {
                store.setCertificateEntry("authority" + number++, certificate);
            }
            var managers = TrustManagerFactory.getInstance(TrustManagerFactory.getDefaultAlgorithm());
            managers.init(store);
            var context = SSLContext.getInstance("TLS");
            context.init(null, managers.getTrustManagers(), null);
            return context;
        } catch (CertificateException unreadable) {
            throw wrong(file + ": no certificate in it, expected " + expected);
        } catch (IOException unreadable) {
            throw wrong(FileProblems.message(file, unreadable));
        } catch (GeneralSecurityException missing) {
            throw new IllegalStateException("this Java has no TLS: " + missing.getMessage(), missing);
        }
    }

    private static String hostName() {
        try {
            return InetAddress.getLocalHost().getHostName();
        } catch (UnknownHostException nameless) {
            return "host";
        }
    }

    private ParameterException wrong(String problem) {
        return new ParameterException(spec.commandLine(), problem);
    }
}
