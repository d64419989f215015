@echo off
rem Runs Troupe's command line on a JDK 21 or later, and builds it first when it is missing or older than its sources.
setlocal enabledelayedexpansion
set "ROOT=%~dp0"
set "CLASSPATH_FILE=%ROOT%demo\target\classpath.txt"

set "JDK="
if defined JAVA_HOME call :try "%JAVA_HOME%"
for /f "delims=" %%j in ('where java 2^>nul') do if not defined JDK call :try "%%~dpj.."
for %%p in ("%ProgramFiles%\Java" "%ProgramFiles%\Eclipse Adoptium" "%ProgramFiles%\Microsoft" "%ProgramFiles%\Zulu" "%USERPROFILE%\.jdks") do (
    for /d %%j in ("%%~p\*") do if not defined JDK call :try "%%~j"
)
if not defined JDK (
    echo troupe: no JDK 21 or later found. Looked at JAVA_HOME ^(%JAVA_HOME%^), java on PATH, the folders Java, Eclipse Adoptium,>&2
    echo Microsoft and Zulu in "%ProgramFiles%", and "%USERPROFILE%\.jdks". Install one, or set JAVA_HOME to it.>&2
    exit /b 1
)
set "JAVA_HOME=%JDK%"

call :up_to_date
if errorlevel 1 (
    set "LOG=%TEMP%\troupe-build-%RANDOM%.log"
    call mvn -B -ntp -f "%ROOT%pom.xml" process-classes -pl demo -am >"!LOG!" 2>&1
    if errorlevel 1 (
        type "!LOG!" >&2
        del "!LOG!"
        echo troupe: the build failed, see above ^(it needs mvn on PATH^)>&2
        exit /b 1
    )
    del "!LOG!"
)
set "CP="
for /f "usebackq delims=" %%c in ("%CLASSPATH_FILE%") do set "CP=%%c"
"%JAVA_HOME%\bin\java.exe" "-Dtroupe.home=%ROOT%." -cp "%ROOT%demo\target\classes;%CP%" io.troupe.demo.Main %*
exit /b %ERRORLEVEL%

:try
if not exist "%~1\bin\javac.exe" exit /b
for /f tokens^=2^ delims^=^" %%v in ('findstr /b JAVA_VERSION^= "%~1\release" 2^>nul') do (
    for /f "delims=." %%m in ("%%v") do if %%m geq 21 set "JDK=%~f1"
)
exit /b

:up_to_date
if not exist "%CLASSPATH_FILE%" exit /b 1
powershell -NoProfile -Command "$built = (Get-Item $env:CLASSPATH_FILE).LastWriteTime; Set-Location $env:ROOT; if (Get-ChildItem pom.xml, */pom.xml, */src/main -Recurse | Where-Object { $_.LastWriteTime -gt $built } | Select-Object -First 1) { exit 1 }"
exit /b %ERRORLEVEL%
