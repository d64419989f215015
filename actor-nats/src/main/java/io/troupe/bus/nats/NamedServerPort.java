package io.troupe.bus.nats;

import io.nats.client.ErrorListener;
import io.nats.client.Options;
import io.nats.client.impl.SocketDataPort;
import java.io.IOException;
import java.net.InetAddress;
import java.net.URI;
import java.net.UnknownHostException;
import java.security.cert.CertificateParsingException;
import java.security.cert.X509Certificate;
import java.util.ArrayList;
import java.util.Collection;
import java.util.List;
import java.util.Locale;
import java.util.Objects;
import java.util.regex.Pattern;
import javax.net.ssl.SSLException;
import javax.net.ssl.SSLPeerUnverifiedException;
import javax.net.ssl.SSLSocket;
import org.jspecify.annotations.Nullable;

/**
 * A connection whose certificate is for the host that was asked for; the client alone accepts a certificate for any
 * name, if its authority is trusted. The name is checked after the handshake and before anything is sent, so no other
 * server gets the password.
 *
 * <p>The names are those in the certificate's subjectAltName: DNS names, with {@code *} as the whole first part, and
 * addresses. The client looks up the addresses of a host itself, and learns those of a cluster from its servers; at an
 * address that was not configured, one of the configured names counts.
 *
 * @hidden public because the client makes an instance by the name of the class
 */
public final class NamedServerPort extends SocketDataPort {
    private static final int DNS_NAME = 2;
    private static final int ADDRESS = 7;
    /** What a DNS name cannot be: four numbers, or something with a colon. */
    private static final Pattern NUMERIC = Pattern.compile("[0-9]+(\\.[0-9]+){3}|.*:.*");

    private List<String> configured = List.of();
    private @Nullable ErrorListener problems;

    @Override
    public void afterConstruct(Options options) {
        super.afterConstruct(options);
        problems = options.getErrorListener();
        configured = options.getServers().stream()
                .map(URI::getHost)
                .filter(Objects::nonNull)
                .toList();
    }

    @Override
    public void upgradeToSecure() throws IOException {
        super.upgradeToSecure();
        if (socket instanceof SSLSocket encrypted) { // else the handshake has failed, which the client has reported
            check(encrypted, expected(host, configured));
        }
    }

    /**
     * A server that asks for a certificate of this process refuses it after the handshake, by an alert. While the
     * client connects, it keeps this to itself and waits for its whole limit.
     */
    @Override
    public int read(byte[] target, int from, int length) throws IOException {
        try {
            return super.read(target, from, length);
        } catch (SSLException refused) {
            if (problems != null) {
                problems.exceptionOccurred(connection, refused);
            }
            throw refused;
        }
    }

    /** The names of which the certificate must have one. */
    static List<String> expected(String host, List<String> configured) {
        return isAddress(host) && !configured.contains(host)
                ? concat(configured.stream().filter(name -> !isAddress(name)).toList(), host)
                : List.of(host);
    }

    private static List<String> concat(List<String> names, String last) {
        var all = new ArrayList<>(names);
        all.add(last);
        return all;
    }

    private static void check(SSLSocket socket, List<String> expected) throws IOException {
        var certificate = socket.getSession().getPeerCertificates()[0];
        var names = certificate instanceof X509Certificate x509 ? alternativeNames(x509) : List.<Name>of();
        if (expected.stream().noneMatch(host -> names.stream().anyMatch(name -> name.isOf(host)))) {
            socket.close();
            throw new SSLPeerUnverifiedException("the certificate of the server is for "
                    + (names.isEmpty() ? "no host (it has no subjectAltName)" : String.join(", ", texts(names)))
                    + ", expected one for " + String.join(" or ", expected));
        }
    }

    private static List<String> texts(List<Name> names) {
        return names.stream().map(Name::text).toList();
    }

    /** A name in a certificate. */
    record Name(boolean isAddress, String text) {
        boolean isOf(String host) {
            if (isAddress || NamedServerPort.isAddress(host)) {
                return isAddress && NamedServerPort.isAddress(host) && isEqual(host, text);
            }
            String wanted = normal(host);
            String given = normal(text);
            if (!given.startsWith("*.")) {
                return wanted.equals(given);
            }
            int dot = wanted.indexOf('.');
            String rest = given.substring(1);
            return dot > 0 && rest.indexOf('.', 1) > 0 && wanted.substring(dot).equals(rest);
        }

        /** Without the dot at the end that a full name may have. */
        private static String normal(String name) {
            String lower = name.toLowerCase(Locale.ROOT);
            return lower.endsWith(".") ? lower.substring(0, lower.length() - 1) : lower;
        }

        private static boolean isEqual(String numbers, String others) {
            try {
                return InetAddress.getByName(numbers).equals(InetAddress.getByName(others)); // looks nothing up
            } catch (UnknownHostException malformed) {
                return false;
            }
        }
    }

    private static boolean isAddress(String host) {
        return NUMERIC.matcher(host).matches();
    }

    private static List<Name> alternativeNames(X509Certificate certificate) throws SSLException {
        try {
            Collection<List<?>> all = certificate.getSubjectAlternativeNames();
            return all == null
                    ? List.of()
                    : all.stream()
                            .filter(each -> each.getFirst().equals(DNS_NAME)
                                    || each.getFirst().equals(ADDRESS))
                            .map(each -> new Name(each.getFirst().equals(ADDRESS), String.valueOf(each.get(1))))
                            .toList();
        } catch (CertificateParsingException malformed) {
            throw new SSLException("the names in the certificate of the server cannot be read", malformed);
        }
    }
}
