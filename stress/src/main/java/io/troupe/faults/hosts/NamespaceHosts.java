package io.troupe.faults.hosts;

import java.io.IOException;
import java.nio.charset.StandardCharsets;
import java.util.ArrayList;
import java.util.List;
import java.util.regex.Matcher;
import java.util.regex.Pattern;
import java.util.stream.Stream;
import org.jspecify.annotations.Nullable;

/**
 * A network namespace for each host, connected by a bridge. Names contain the number of this process, so that a later
 * run finds what one that was killed has left.
 */
final class NamespaceHosts implements Hosts {
    private static final Pattern NAME = Pattern.compile("troupe-faults-(\\d+)-\\w+");
    private static final Pattern BRIDGE = Pattern.compile("tfb(\\d+)");

    private final long pid = ProcessHandle.current().pid();
    private final String network = "10.213." + pid % 256 + ".";

    private NamespaceHosts() {}

    /** Returns why this machine allows none, or null. */
    static @Nullable String whyImpossible() {
        String probe = "troupe-faults-" + ProcessHandle.current().pid() + "-probe";
        try {
            ip("netns", "add", probe);
            ip("netns", "del", probe);
            return null;
        } catch (IOException refused) {
            return refused.getMessage();
        }
    }

    static NamespaceHosts open() throws IOException {
        removeLeftovers();
        var hosts = new NamespaceHosts();
        try {
            hosts.build();
            return hosts;
        } catch (IOException | RuntimeException failure) {
            hosts.close();
            throw failure;
        }
    }

    private void build() throws IOException {
        ip("link", "add", bridge(), "type", "bridge");
        ip("addr", "add", network + "254/24", "dev", bridge());
        ip("link", "set", bridge(), "up");
        for (String host : all()) {
            ip("netns", "add", namespace(host));
            ip("link", "add", link(host), "type", "veth", "peer", "name", "eth0", "netns", namespace(host));
            ip("-n", namespace(host), "addr", "add", address(host) + "/24", "dev", "eth0");
            ip("-n", namespace(host), "link", "set", "lo", "up");
            ip("-n", namespace(host), "link", "set", "eth0", "up");
            heal(host);
        }
    }

    private static List<String> all() {
        return Stream.concat(Stream.of(SERVER, ARBITRATOR, WORLD), NODES.stream())
                .toList();
    }

    private String namespace(String host) {
        return "troupe-faults-" + pid + "-" + host;
    }

    private String link(String host) {
        return "tf" + pid + host;
    }

    private String bridge() {
        return "tfb" + pid;
    }

    @Override
    public String address(String host) {
        return network + (1 + all().indexOf(host));
    }

    @Override
    public List<String> on(String host, List<String> command) {
        var all = new ArrayList<>(List.of("ip", "netns", "exec", namespace(host)));
        all.addAll(command);
        return all;
    }

    @Override
    public boolean canCut() {
        return true;
    }

    @Override
    public void cut(String host, boolean silently) throws IOException {
        if (silently) {
            ip("link", "set", link(host), "nomaster");
        } else {
            ip("link", "set", link(host), "down");
        }
    }

    @Override
    public void heal(String host) throws IOException {
        ip("link", "set", link(host), "master", bridge());
        ip("link", "set", link(host), "up");
    }

    @Override
    public void cutWay(String from, String to) throws IOException {
        ip("-n", namespace(from), "route", "add", "blackhole", address(to) + "/32");
    }

    @Override
    public void healWay(String from, String to) throws IOException {
        ip("-n", namespace(from), "route", "del", "blackhole", address(to) + "/32");
    }

    @Override
    public void close() throws IOException {
        for (String host : all()) {
            remove(namespace(host));
        }
        removeBridge(bridge());
    }

    @Override
    public String toString() {
        return "network namespaces, connected by the bridge " + bridge();
    }

    private static void removeLeftovers() throws IOException {
        for (String line : ip("netns", "list").lines().toList()) {
            Matcher name = NAME.matcher(line.split(" ")[0]);
            if (name.matches() && !isRunning(name.group(1))) {
                remove(name.group());
            }
        }
        Matcher bridge = BRIDGE.matcher(ip("-o", "link", "show", "type", "bridge"));
        while (bridge.find()) {
            if (!isRunning(bridge.group(1))) {
                removeBridge(bridge.group());
            }
        }
    }

    private static boolean isRunning(String process) {
        return ProcessHandle.of(Long.parseLong(process)).isPresent();
    }

    /** Also ends the processes in it; its links go with it. */
    private static void remove(String namespace) throws IOException {
        if (ip("netns", "list").lines().noneMatch(line -> line.split(" ")[0].equals(namespace))) {
            return;
        }
        ip("netns", "pids", namespace)
                .lines()
                .flatMap(process -> ProcessHandle.of(Long.parseLong(process.strip())).stream())
                .forEach(ProcessHandle::destroyForcibly);
        ip("netns", "del", namespace);
    }

    private static void removeBridge(String bridge) throws IOException {
        if (ip("-o", "link", "show", "type", "bridge").contains(" " + bridge + ":")) {
            ip("link", "del", bridge);
        }
    }

    private static String ip(String... arguments) throws IOException {
        var command = new ArrayList<>(List.of("ip"));
        command.addAll(List.of(arguments));
        Process process = new ProcessBuilder(command).redirectErrorStream(true).start();
        String output = new String(process.getInputStream().readAllBytes(), StandardCharsets.UTF_8);
        try {
            if (process.waitFor() != 0) {
                throw new IOException(String.join(" ", command) + ": " + output.strip());
            }
        } catch (InterruptedException interrupted) {
            Thread.currentThread().interrupt();
            throw new IOException("interrupted", interrupted);
        }
        return output;
    }
}
