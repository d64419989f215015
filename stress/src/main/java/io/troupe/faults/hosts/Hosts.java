package io.troupe.faults.hosts;

import java.io.IOException;
import java.util.List;

/**
 * Where the processes of a run are: a server, and the hosts {@code a}, {@code b} and {@code c} that are connected with
 * it. Robot services also have a host for the arbitrator and one for the world.
 */
public interface Hosts extends AutoCloseable {
    String SERVER = "s";

    List<String> NODES = List.of("a", "b", "c");

    String ARBITRATOR = "m";

    String WORLD = "w";

    /** The kinds of hosts. */
    enum Kind {
        NAMESPACES,
        PROCESSES,
        AUTO
    }

    /** One line for people. */
    @Override
    String toString();

    /** The address of a host, for the others and for this process. */
    String address(String host);

    /** The command that runs a command on a host; the process that is started becomes that command. */
    List<String> on(String host, List<String> command);

    /** Returns whether links can be cut. */
    boolean canCut();

    /**
     * Cuts the link of a host, so that TCP does not notice.
     *
     * @param silently true: the host's network device does not notice either
     */
    void cut(String host, boolean silently) throws IOException;

    /** Cuts the way from one host to another one, for both directions of TCP. */
    void cutWay(String from, String to) throws IOException;

    /** Heals that way. */
    void healWay(String from, String to) throws IOException;

    /** Heals the link of a host. */
    void heal(String host) throws IOException;

    @Override
    void close() throws IOException;

    /**
     * Opens hosts, and removes what an earlier run that was killed has left.
     *
     * @throws IOException if these hosts are not possible on this machine; with the kind {@code AUTO} never for that
     */
    static Hosts open(Kind kind) throws IOException {
        if (kind == Kind.PROCESSES) {
            return new LoopbackHosts("as demanded");
        }
        String why = NamespaceHosts.whyImpossible();
        if (why == null) {
            return NamespaceHosts.open();
        } else if (kind == Kind.NAMESPACES) {
            throw new IOException("no network namespaces: " + why);
        }
        return new LoopbackHosts("no network namespaces: " + why);
    }

    /** Processes of this machine on loopback: no link can be cut. */
    record LoopbackHosts(String why) implements Hosts {
        @Override
        public String address(String host) {
            return "127.0.0.1";
        }

        @Override
        public List<String> on(String host, List<String> command) {
            return command;
        }

        @Override
        public boolean canCut() {
            return false;
        }

        @Override
        public void cut(String host, boolean silently) {
            throw new UnsupportedOperationException("loopback cannot be cut");
        }

        @Override
        public void heal(String host) {
            throw new UnsupportedOperationException("loopback cannot be cut");
        }

        @Override
        public void cutWay(String from, String to) {
            throw new UnsupportedOperationException("loopback cannot be cut");
        }

        @Override
        public void healWay(String from, String to) {
            throw new UnsupportedOperationException("loopback cannot be cut");
        }

        @Override
        public void close() {}

        @Override
        public String toString() {
            return "processes on loopback (" + why + "): no link is cut";
        }
    }
}
