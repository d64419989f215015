package io.troupe.services.subsumption;

import io.troupe.services.subsumption.ServiceCatalogue.Kind;
import java.io.IOException;
import java.lang.System.Logger.Level;
import java.net.URL;
import java.net.URLClassLoader;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.ArrayList;
import java.util.Iterator;
import java.util.List;
import java.util.ServiceConfigurationError;
import java.util.ServiceLoader;
import java.util.jar.JarFile;

/**
 * A jar with kinds of services: those of each {@link ServiceKinds} provider that is listed in its
 * {@code META-INF/services}.
 *
 * <p><b>Role.</b> Each jar has a separate class loader, which sees the classes of Troupe but not those of other jars.
 * It must stay open as long as services of these kinds run, since classes are loaded at their first use; so close it
 * after the run.
 *
 * <p><b>Errors.</b> {@link ServiceJarException}, which names the jar: the file does not exist, is not a jar, or lists
 * no provider; a provider cannot be loaded or throws; or a kind has a name that is taken.
 */
public final class ServiceJar implements AutoCloseable {
    private static final System.Logger LOG = System.getLogger(ServiceJar.class.getName());
    private static final String PROVIDERS = "META-INF/services/" + ServiceKinds.class.getName();

    private final Path jar;
    private final URLClassLoader loader;
    private final List<Kind> kinds;

    private ServiceJar(Path jar, URLClassLoader loader) {
        this.jar = jar;
        this.loader = loader;
        this.kinds = load();
    }

    /**
     * Opens a jar, or a directory of classes, and loads the kinds of its providers.
     *
     * @throws ServiceJarException if that fails
     */
    public static ServiceJar open(Path jar) {
        check(jar);
        var loader = new URLClassLoader(new URL[] {url(jar)}, ServiceKinds.class.getClassLoader());
        try {
            return new ServiceJar(jar, loader);
        } catch (RuntimeException | Error unusable) {
            try {
                loader.close();
            } catch (IOException unclosed) {
                unusable.addSuppressed(unclosed);
            }
            throw unusable;
        }
    }

    /**
     * Checks that the file is a jar. A class loader would ignore an unreadable file, and the error would then be about
     * a missing provider.
     */
    private static void check(Path jar) {
        if (!Files.exists(jar)) {
            throw new ServiceJarException(jar, "no such file, expected a jar with kinds of services");
        }
        if (!Files.isDirectory(jar)) {
            try (var opened = new JarFile(jar.toFile())) {
                LOG.log(Level.DEBUG, "{0} has {1} entries", jar, opened.size());
            } catch (IOException unreadable) {
                throw new ServiceJarException(
                        jar, "it cannot be read as a jar: " + unreadable.getMessage() + ", expected a jar", unreadable);
            }
        }
    }

    private static URL url(Path jar) {
        try {
            return jar.toUri().toURL();
        } catch (IOException impossible) {
            throw new ServiceJarException(jar, "it has no URL, expected a file of this machine", impossible);
        }
    }

    private List<Kind> load() {
        if (loader.findResource(PROVIDERS) == null) {
            throw new ServiceJarException(
                    jar, "there is no " + PROVIDERS + " in it, expected that file with the name of a class");
        }
        List<Kind> all = new ArrayList<>();
        boolean found = false;
        for (var providers =
                        ServiceLoader.load(ServiceKinds.class, loader).stream().iterator();
                hasNext(providers); ) {
            var provider = providers.next();
            if (provider.type().getClassLoader() == loader) { // not a provider on Troupe's class path
                found = true;
                all.addAll(kindsOf(provider));
            }
        }
        if (!found) {
            throw new ServiceJarException(
                    jar, PROVIDERS + " names no class of it, expected one that implements ServiceKinds");
        }
        return List.copyOf(all);
    }

    private boolean hasNext(Iterator<?> providers) {
        try {
            return providers.hasNext();
        } catch (ServiceConfigurationError | LinkageError unusable) {
            throw unusable(unusable);
        }
    }

    private List<Kind> kindsOf(ServiceLoader.Provider<ServiceKinds> provider) {
        try {
            return List.copyOf(provider.get().kinds());
        } catch (ServiceConfigurationError unusable) {
            throw unusable(unusable);
        } catch (RuntimeException | LinkageError thrown) {
            throw new ServiceJarException(
                    jar, provider.type().getName() + " threw " + thrown + ", expected its kinds of services", thrown);
        }
    }

    /**
     * Converts an error of the service loader: removes the interface's name from its message, and adds the root cause.
     */
    private ServiceJarException unusable(Throwable error) {
        String text = String.valueOf(error.getMessage()).replace(ServiceKinds.class.getName() + ": ", "");
        Throwable root = error;
        while (root.getCause() != null) {
            root = root.getCause(); // thrown by a constructor or a static initializer
        }
        String cause = root == error ? "" : " (" + root + ")";
        return new ServiceJarException(
                jar, text + cause + ", expected a public class that implements ServiceKinds and can be made", error);
    }

    /** The kinds, in the order in which the jar lists their providers. */
    public List<Kind> kinds() {
        return kinds;
    }

    /**
     * Returns a catalogue with the kinds of this jar added.
     *
     * @throws ServiceJarException if the catalogue has a kind of that name already
     */
    public ServiceCatalogue addTo(ServiceCatalogue catalogue) {
        ServiceCatalogue more = catalogue;
        for (Kind kind : kinds) {
            try {
                more = more.with(kind);
            } catch (IllegalArgumentException taken) {
                throw new ServiceJarException(jar, taken.getMessage() + ", expected another name", taken);
            }
        }
        return more;
    }

    /** Closes the class loader; no further class of the jar can be loaded. */
    @Override
    public void close() {
        try {
            loader.close();
        } catch (IOException unclosed) {
            LOG.log(Level.WARNING, jar + " cannot be closed", unclosed);
        }
    }
}
