package io.troupe.actor;

import java.security.AccessControlContext;
import java.security.AccessController;
import java.security.PrivilegedAction;
import java.security.ProtectionDomain;
import java.util.function.Supplier;

/**
 * Creates threads that may outlive the code which happens to need them first. They keep nothing of it: up to Java 23 a
 * new thread keeps the protection domains of all callers, and with these their class loaders.
 */
final class CleanThreads {
    @SuppressWarnings("removal")
    private static final AccessControlContext NOBODY = new AccessControlContext(new ProtectionDomain[0]);

    private CleanThreads() {}

    @SuppressWarnings("removal")
    static <T extends Thread> T create(Supplier<T> constructor) {
        return AccessController.doPrivileged((PrivilegedAction<T>) constructor::get, NOBODY);
    }
}
