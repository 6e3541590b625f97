using System;
using System.Collections.Generic;
using System.IO;
using System.Security.Cryptography;
using System.Text;
using LagSim.Net.Protection;
using Microsoft.AspNetCore.Builder;
using Microsoft.AspNetCore.Http;
using Microsoft.Extensions.Hosting;
using Microsoft.Extensions.Logging;

// A backend that admits players to a LagSim host: a player logs in here, and takes the token it gets to the host.
//
//   dotnet run --project samples/TokenBackend -- SECRET-FILE                      prints the key for 'lagsim host --tokens'
//   dotnet run --project samples/TokenBackend -- SECRET-FILE lagsim://... [PORT]  serves POST /token
//
// A real backend has its own accounts, listens with HTTPS, and keeps the issuer's secret in its vault.

if (args.Length is < 1 or > 3)
{
    Console.Error.WriteLine("Usage: TokenBackend SECRET-FILE [lagsim://HOST:PORT#FINGERPRINT [PORT]]");
    return 2;
}

using TokenIssuer issuer = ReadOrDraw(args[0]);
Console.WriteLine($"key {issuer.Key}");
if (args.Length == 1)
{
    return 0;
}

if (!HostAddress.TryParse(args[1], out HostAddress? host) || !ushort.TryParse(args.Length > 2 ? args[2] : "5080", out ushort port))
{
    Console.Error.WriteLine($"'{string.Join(' ', args[1..])}' is not an address that a LagSim host prints, and a port from 0 to 65535.");
    return 2;
}

// Who may play, by login. A database has these.
Dictionary<string, PlayerAdmission> accounts = new()
{
    [HashOf("ada's password")] = new PlayerAdmission("account 1", "Ada"),
    [HashOf("bob's password")] = new PlayerAdmission("account 2", "Bob"),
    [HashOf("eve's password")] = new PlayerAdmission("account 3", "Eve", PlayerRights.None), // she watches
};

WebApplicationBuilder builder = WebApplication.CreateSlimBuilder();
builder.Logging.SetMinimumLevel(LogLevel.Warning);
WebApplication app = builder.Build();
app.Urls.Add($"http://127.0.0.1:{port}");
app.MapPost("/token", IResult (HttpRequest request) =>
{
    const string scheme = "Bearer ";
    string login = request.Headers.Authorization.ToString();
    if (!login.StartsWith(scheme, StringComparison.Ordinal) || !accounts.TryGetValue(HashOf(login[scheme.Length..]), out PlayerAdmission? player))
    {
        return Results.Unauthorized();
    }

    // Here a real backend decides: is the player banned, is there a place, which of many hosts is near?
    byte[] token = issuer.Issue(player, host!.Fingerprint);
    return Results.Text(
        $$"""{ "address": "{{host}}", "token": "{{Convert.ToBase64String(token)}}" }""", "application/json");
});
await app.StartAsync();
foreach (string url in app.Urls)
{
    Console.WriteLine($"serving {url}/token");
}

await app.WaitForShutdownAsync();
return 0;

static string HashOf(string login) => Convert.ToHexString(SHA256.HashData(Encoding.UTF8.GetBytes(login)));

static TokenIssuer ReadOrDraw(string file)
{
    if (File.Exists(file))
    {
        return TokenIssuer.TryParse(File.ReadAllText(file).Trim(), out TokenIssuer? kept)
            ? kept!
            : throw new InvalidDataException($"'{file}' holds no secret of an issuer: 64 hexadecimal digits.");
    }

    TokenIssuer drawn = TokenIssuer.Draw();
    FileStreamOptions options = new() { Mode = FileMode.CreateNew, Access = FileAccess.Write };
    if (!OperatingSystem.IsWindows())
    {
        options.UnixCreateMode = UnixFileMode.UserRead | UnixFileMode.UserWrite;
    }

    using FileStream stream = new(file, options);
    stream.Write(Encoding.ASCII.GetBytes(drawn.ToSecretText()));
    return drawn;
}
