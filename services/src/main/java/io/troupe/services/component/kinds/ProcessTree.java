package io.troupe.services.component.kinds;

import io.troupe.actor.Clock;
import io.troupe.common.process.Programs;
import java.io.File;
import java.io.IOException;
import java.io.UncheckedIOException;
import java.nio.charset.StandardCharsets;
import java.nio.file.AccessDeniedException;
import java.nio.file.DirectoryIteratorException;
import java.nio.file.Files;
import java.nio.file.NoSuchFileException;
import java.nio.file.Path;
import java.time.Duration;
import java.util.ArrayList;
import java.util.HashMap;
import java.util.HashSet;
import java.util.LinkedHashSet;
import java.util.List;
import java.util.Map;
import java.util.Optional;
import java.util.Set;
import java.util.concurrent.TimeUnit;
import java.util.concurrent.locks.LockSupport;
import java.util.function.Consumer;
import java.util.regex.Pattern;
import org.jspecify.annotations.Nullable;

/**
 * A program and all processes that it has started.
 *
 * <p><b>Role.</b> On Linux, if the command {@code setsid} exists, the program leads a session. All processes of the
 * session belong to the tree, even after their parents have ended. Otherwise the descendants of the program belong to
 * the tree, and are found only while their parents live. A process that opens a new session is found only while its
 * parent lives.
 *
 * <p><b>Threads.</b> Any. It reads the process table, which blocks: do not call it on an actor space.
 */
final class ProcessTree {
    private static final Path PROCESS_TABLE = Path.of("/proc");

    /** The variables of our commands begin with this; a password of the bus is among them. */
    private static final String OURS = "TROUPE_";

    /**
     * The start of a line in {@code /proc/PID/stat}: process number, name (which may contain blanks and brackets),
     * state, parent, group and session. Does not match a zombie.
     */
    private static final Pattern STAT =
            Pattern.compile("[^(]*\\(.*\\) [^ZX] (\\d{1,18}) -?\\d+ (\\d{1,18})\\b", Pattern.DOTALL);

    private static final long FIRST_PAUSE_NANOS = TimeUnit.MILLISECONDS.toNanos(1);
    private static final long LONGEST_PAUSE_NANOS = TimeUnit.MILLISECONDS.toNanos(20);
    private static final long FIRST_REPETITION_NANOS = TimeUnit.MILLISECONDS.toNanos(100);

    /**
     * An entry of the Linux process table. Zombies, which have ended but have not been reaped by their parents, are
     * left out.
     */
    record Entry(long pid, long parent, long session) {}

    private final Process root;
    private final boolean leadsSession;
    private final Set<ProcessHandle> known = new LinkedHashSet<>(); // guarded by this

    private ProcessTree(Process root, boolean leadsSession) {
        this.root = root;
        this.leadsSession = leadsSession;
    }

    /** Starts a program, in a new session if the system supports it. */
    static ProcessTree start(ProcessComponent.Settings settings) throws IOException {
        boolean hasTable = Files.isReadable(PROCESS_TABLE.resolve("self/stat"));
        return start(settings, hasTable ? Programs.onPath("setsid").orElse(null) : null);
    }

    /** Starts a program, in a new session if {@code setsid} is given. */
    static ProcessTree start(ProcessComponent.Settings settings, @Nullable Path setsid) throws IOException {
        return start(settings, setsid, System.getenv());
    }

    /** Starts a program with the environment of this process, without {@link #OURS}. */
    static ProcessTree start(ProcessComponent.Settings settings, @Nullable Path setsid, Map<String, String> environment)
            throws IOException {
        List<String> command = new ArrayList<>(settings.command());
        // setsid reports a missing program only by an exit status; the error of ProcessBuilder names the reason
        boolean session = setsid != null && isProgram(command.getFirst(), settings.directory());
        if (session) {
            command.addFirst(setsid.toString());
        }
        var builder = new ProcessBuilder(command).directory(settings.directory().toFile());
        builder.environment().clear();
        builder.environment().putAll(environment);
        builder.environment().keySet().removeIf(name -> name.startsWith(OURS));
        return new ProcessTree(builder.start(), session);
    }

    private static boolean isProgram(String name, Path directory) {
        return name.contains(File.separator)
                ? Files.isExecutable(directory.resolve(name))
                : Programs.onPath(name).isPresent();
    }

    /** The process of the program. */
    Process root() {
        return root;
    }

    /** Adds a process to the tree. */
    synchronized void add(ProcessHandle process) {
        known.add(process);
    }

    /** The processes of the tree that have not ended. */
    synchronized List<ProcessHandle> alive() {
        boolean foundAlive;
        // scan again if the last process may have started another one, unseen, before it ended
        do {
            foundAlive = scan();
            known.removeIf(this::hasEnded);
        } while (foundAlive && known.isEmpty());
        return List.copyOf(known);
    }

    /** Scans for processes of the tree; true if any was alive during the scan. */
    private boolean scan() {
        known.removeIf(this::hasEnded);
        if (root.isAlive()) {
            known.add(root.toHandle());
        }
        if (leadsSession) {
            known.addAll(inSession());
        } else {
            List.copyOf(known).forEach(each -> each.descendants().forEach(known::add));
        }
        return !known.isEmpty();
    }

    private boolean hasEnded(ProcessHandle process) {
        if (process.pid() == root.pid()) {
            return !root.isAlive();
        }
        return !process.isAlive()
                || leadsSession
                        && entry(PROCESS_TABLE, String.valueOf(process.pid())).isEmpty();
    }

    /** The processes in the session, and all descendants of these and of the known processes. */
    private List<ProcessHandle> inSession() {
        List<Entry> others = new ArrayList<>(entries(PROCESS_TABLE));
        Set<Long> members = new HashSet<>();
        known.forEach(each -> members.add(each.pid()));
        Set<Long> found = new LinkedHashSet<>();
        boolean grows = true;
        while (grows) {
            grows = false;
            for (var each : List.copyOf(others)) {
                if (each.session() == root.pid() || members.contains(each.parent())) {
                    others.remove(each);
                    members.add(each.pid());
                    found.add(each.pid());
                    grows = true;
                }
            }
        }
        return found.stream().map(ProcessHandle::of).flatMap(Optional::stream).toList();
    }

    /**
     * All entries of a process table.
     *
     * @throws UncheckedIOException if the table cannot be read, so that the living processes are unknown
     */
    static List<Entry> entries(Path table) {
        List<Entry> entries = new ArrayList<>();
        try (var directories = Files.newDirectoryStream(table, "[0-9]*")) {
            for (var directory : directories) {
                entry(table, directory.getFileName().toString()).ifPresent(entries::add);
            }
        } catch (IOException unreadable) {
            throw unknown(table, unreadable);
        } catch (DirectoryIteratorException unreadable) {
            throw unknown(table, unreadable.getCause());
        }
        return entries;
    }

    private static UncheckedIOException unknown(Path what, IOException why) {
        return new UncheckedIOException(
                "the process table cannot be read at " + what + ", so it is not known which processes are alive: "
                        + why,
                why);
    }

    /** The entry of a process; empty if the process has ended, or is hidden because it belongs to another user. */
    private static Optional<Entry> entry(Path table, String pid) {
        Path directory = table.resolve(pid);
        String line;
        try {
            byte[] bytes = Files.readAllBytes(directory.resolve("stat"));
            line = new String(bytes, StandardCharsets.ISO_8859_1);
        } catch (NoSuchFileException | AccessDeniedException gone) {
            return Optional.empty();
        } catch (IOException unreadable) {
            if (Files.notExists(directory)) { // it ended during the read
                return Optional.empty();
            }
            throw unknown(directory, unreadable);
        }
        var fields = STAT.matcher(line);
        return fields.lookingAt()
                ? Optional.of(new Entry(
                        Long.parseLong(pid), Long.parseLong(fields.group(1)), Long.parseLong(fields.group(2))))
                : Optional.empty();
    }

    /**
     * Requests each process to end, including those started meanwhile, and kills those that have not ended within the
     * limit. Blocks.
     *
     * <p>The request is repeated while a process lives, after pauses that double: a process that its shell has just
     * started has the shell's handlers until it runs its program, and loses a request that comes in between.
     *
     * @param limit time that the processes have to end on request
     * @param killLimit time limit for the end of killed processes
     * @return the processes that are still alive; usually empty
     */
    List<ProcessHandle> end(Duration limit, Duration killLimit) {
        var unresponsive = awaitEnd(limit, ProcessHandle::destroy);
        return unresponsive.isEmpty() ? unresponsive : awaitEnd(killLimit, ProcessHandle::destroyForcibly);
    }

    /** A request to a process: when it is made again, and the pause before. */
    private record Repetition(long atNanos, long pauseNanos) {}

    /**
     * Makes a request to all processes until none is alive or the limit is over; at least once, and then looks at least
     * once whether they live, however long a look takes. Each poll scans again, since living processes may start
     * others.
     */
    private List<ProcessHandle> awaitEnd(Duration limit, Consumer<ProcessHandle> request) {
        long limitNanos = TimeUnit.NANOSECONDS.convert(limit);
        long begunNanos = Clock.system().nanos();
        long pauseNanos = FIRST_PAUSE_NANOS;
        Map<ProcessHandle, Repetition> repetitions = new HashMap<>();
        while (true) {
            var left = alive();
            long spentNanos = Clock.system().nanos() - begunNanos;
            if (left.isEmpty() || !repetitions.isEmpty() && spentNanos >= limitNanos) {
                return left;
            }
            for (ProcessHandle each : left) {
                Repetition next = repetitions.get(each);
                if (next == null || spentNanos >= next.atNanos) {
                    request.accept(each);
                    long wait = next == null ? FIRST_REPETITION_NANOS : 2 * next.pauseNanos;
                    repetitions.put(each, new Repetition(spentNanos + wait, wait));
                }
            }
            LockSupport.parkNanos(pauseNanos);
            pauseNanos = Math.min(2 * pauseNanos, LONGEST_PAUSE_NANOS);
        }
    }
}
