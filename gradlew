#!/bin/sh
# Runs Gradle in the version that gradle/wrapper/gradle-wrapper.properties names, and downloads it the first time.

root=$(cd "$(dirname "$0")" && pwd -P) || exit 1
distributions=${GRADLE_USER_HOME:-$HOME/.gradle}/wrapper/dists
version=$(sed -n 's|^distributionUrl=.*/\(gradle-.*\)\.zip$|\1|p' "$root/gradle/wrapper/gradle-wrapper.properties")

if [ -n "${JAVA_HOME:-}" ]; then
    java=$JAVA_HOME/bin/java
else
    java=java
fi
if ! command -v "$java" >/dev/null 2>&1; then
    echo "gradlew: no java at $java; set JAVA_HOME to a JDK 21 or later" >&2
    exit 1
fi

installed() {
    for marker in "$distributions/$version"/*/*.zip.ok; do
        [ -e "$marker" ] && return 0
    done
    return 1
}

wrapper() {
    # unquoted on purpose: JAVA_OPTS and GRADLE_OPTS hold several words
    # shellcheck disable=SC2086
    "$java" ${JAVA_OPTS:-} ${GRADLE_OPTS:-} -Dorg.gradle.appname=gradlew \
        -classpath "$root/gradle/wrapper/gradle-wrapper.jar" org.gradle.wrapper.GradleWrapperMain "$@"
}

wrapper "$@"
status=$?
if [ $status -ne 0 ] && ! installed; then
    cat >&2 <<EOF

gradlew: $version could not be downloaded from services.gradle.org (see above).
The same build runs with Maven, which needs Maven Central only:
    mvn -B -ntp verify                                          instead of ./gradlew check
    mvn -B -q -ntp compile exec:exec -pl demo -am               instead of ./gradlew run
EOF
fi
exit $status
