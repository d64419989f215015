@echo off
rem Runs Gradle in the version that gradle\wrapper\gradle-wrapper.properties names, and downloads it the first time.
setlocal
set "ROOT=%~dp0"
set "JAVA=java"
if defined JAVA_HOME set "JAVA=%JAVA_HOME%\bin\java.exe"
if not defined GRADLE_USER_HOME set "GRADLE_USER_HOME=%USERPROFILE%\.gradle"

"%JAVA%" %JAVA_OPTS% %GRADLE_OPTS% -Dorg.gradle.appname=gradlew ^
    -classpath "%ROOT%gradle\wrapper\gradle-wrapper.jar" org.gradle.wrapper.GradleWrapperMain %*
set STATUS=%ERRORLEVEL%
if %STATUS% equ 0 exit /b 0

for /f "tokens=2 delims==" %%u in ('findstr /b distributionUrl "%ROOT%gradle\wrapper\gradle-wrapper.properties"') do set "VERSION=%%~nu"
for /d %%d in ("%GRADLE_USER_HOME%\wrapper\dists\%VERSION%\*") do if exist "%%d\*.zip.ok" exit /b %STATUS%
echo.>&2
echo gradlew: %VERSION% could not be downloaded from services.gradle.org ^(see above^).>&2
echo The same build runs with Maven, which needs Maven Central only:>&2
echo     mvn -B -ntp verify                              instead of gradlew check>&2
echo     mvn -B -q -ntp compile exec:exec -pl demo -am   instead of gradlew run>&2
exit /b %STATUS%
