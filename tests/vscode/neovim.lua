-- Runs in Neovim (tests/vscode/neovim), in a folder with copies of samples.
local passed, failed = 0, 0
local function check(name, ok, why)
  if ok then
    passed = passed + 1
  else
    failed = failed + 1
    io.stdout:write("FAILED  " .. name .. (why and ": " .. tostring(why) or "") .. "\n")
  end
end
--- What `f` gives once it gives something.
local function soon(f, seconds)
  local value
  vim.wait((seconds or 30) * 1000, function()
    value = f()
    return value
  end, 50)
  return value
end
local function line_of(pattern)
  for i, line in ipairs(vim.api.nvim_buf_get_lines(0, 0, -1, false)) do
    if line:match(pattern) then return i end
  end
end
local function ask(method)
  local answers = vim.lsp.buf_request_sync(0, method, vim.lsp.util.make_position_params(), 20000) or {}
  for _, a in pairs(answers) do return a.result, a.error end
end
--- Text of all floating windows.
local function floating()
  for _, window in ipairs(vim.api.nvim_list_wins()) do
    if vim.api.nvim_win_get_config(window).relative ~= "" then
      return table.concat(vim.api.nvim_buf_get_lines(vim.api.nvim_win_get_buf(window), 0, -1, false), "\n")
    end
  end
end

local function tests()
  vim.cmd("edit every_mistake_0000.rad")
  check("a deck has its file type", vim.bo.filetype == "radioss", vim.bo.filetype)
  check("the server starts", soon(function() return #vim.lsp.buf_get_clients(0) > 0 end))
  local function finding(code)
    for _, d in ipairs(vim.diagnostic.get(0)) do
      if (d.code or (d.user_data and d.user_data.lsp and d.user_data.lsp.code)) == code then return d end
    end
  end
  local wrong = soon(function() return finding("DK171") end)
  check("a finding is there", wrong)
  local card = line_of("^/INTER/TYPE7/31") + 3
  check("at its line and columns", wrong and wrong.lnum == card - 1 and wrong.col == 10 and wrong.end_col == 20, vim.inspect(wrong))
  check("an error", wrong and wrong.severity == vim.diagnostic.severity.ERROR)

  vim.api.nvim_win_set_cursor(0, { card, 25 })
  vim.api.nvim_feedkeys("K", "xt", false)
  local said = soon(floating)
  check("K tells the field under the cursor", said and said:find("Istf") and said:find("Stiffness", 1, true), said)

  vim.cmd("silent edit! include_tree_0000.rad")
  soon(function() return #vim.lsp.buf_get_clients(0) > 0 end)
  vim.cmd("silent edit include_tree/mesh.inc")
  check("an included file has the same server", soon(function() return #vim.lsp.buf_get_clients(0) == 1 end))
  vim.api.nvim_win_set_cursor(0, { line_of("^/NODE") + 2, 15 })
  local hover = soon(function() return ask("textDocument/hover") end)
  check("and knows the columns of its deck", hover and vim.inspect(hover):find("X · columns 11", 1, true), vim.inspect(hover))
end
local ok, why = pcall(tests)
if not ok then check("the tests run to their end", false, why) end
io.stdout:write(string.format("\n%d passed, %d failed\n", passed, failed))
vim.cmd("qa!")
